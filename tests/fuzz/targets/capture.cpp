// A capture: a file of any bytes; and a header with one content behind a line break, whose checksums are made
// right.
#include "capture/capture.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "base/error.h"
#include "capture/capture_header.h"
#include "fuzz/targets/target.h"

using namespace triad;

TRIAD_FUZZ_TARGET(capture) {
    const auto path = fuzz::file_of(input);
    fuzz::answer([](fuzz::Input bytes) { read_capture(fuzz::file_of(bytes)); }, input);
    const std::string text(fuzz::text_of(input));
    const std::size_t end = std::min(text.find('\n'), text.size());
    // Contents of the sizes that headers ask for would never be found by chance: the first is as long as what
    // follows, each next one half as long.
    const std::size_t rest = text.size() - std::min(end + 1, text.size());
    const auto content_at = [&](std::size_t place) {
        AlignedVector<std::byte> bytes(place < 16 ? rest >> place : 0);
        if (!bytes.empty()) std::memcpy(bytes.data(), text.data() + end + 1, bytes.size());
        return std::make_shared<const AlignedVector<std::byte>>(std::move(bytes));
    };
    const Capture capture = capture_of_header(text.substr(0, end), content_at,
                                              [](const std::string& why) { throw Error(Exit::scene, why); });
    write_capture(path, capture);
    read_capture(path);
}
