/// A capture's file: a prefix, the compressed header, and the compressed contents, each with its checksum.
#include <zstd.h>

#include <bit>
#include <cstring>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/memory_limit.h"
#include "capture/capture_header.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

static_assert(std::endian::native == std::endian::little, "captures are written as they lie in memory");

constexpr char magic[12] = {'T', 'R', 'I', 'A', 'D', 'C', 'A', 'P', 'T', 'U', 'R', 'E'};
constexpr std::uint32_t version = 1;
constexpr std::size_t checksum_size = 32;
constexpr int compression = 3;
/// Of the header: a thousand times what captures have.
constexpr std::uint64_t most_header = 16 << 20;
constexpr std::uint64_t most_contents = 1 << 20;
/// No Zstandard frame holds more for each of its bytes: a block of 128 KiB takes four at least.
constexpr std::uint64_t most_expansion = 32768;

struct Prefix {
    char magic[12];
    std::uint32_t version;
    std::uint64_t header_stored, header_bytes, contents;  ///< header_stored: compressed
};
static_assert(sizeof(Prefix) == 40);

/// Of one content, before all of them.
struct Extent {
    std::uint64_t stored, bytes;
};

/// The place is part of the checksum, so that contents cannot change places.
std::string checksum(std::uint64_t place, const void* data, std::size_t bytes) {
    return Hash().add_value(place).add(data, bytes).hex();
}

std::string compressed(const void* data, std::size_t bytes) {
    std::string out(ZSTD_compressBound(bytes), '\0');
    const std::size_t size = ZSTD_compress(out.data(), out.size(), data, bytes, compression);
    if (ZSTD_isError(size))
        throw Error(Exit::memory, std::string("Compressing failed: ") + ZSTD_getErrorName(size) + ".");
    out.resize(size);
    out.shrink_to_fit();
    return out;
}

/// A file that is read from its beginning to its end.
class CaptureReader {
  public:
    explicit CaptureReader(const fs::path& path) : path_(path), file_(path), left_(file_.size()) {}

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error(Exit::scene, "Capture " + path_.string() + " cannot be used: " + why + ".");
    }

    Capture read();

  private:
    fs::path path_;
    InputFile file_;
    std::uint64_t left_;

    void take(void* to, std::uint64_t bytes) {
        if (bytes > left_) refuse("it ends early");
        file_.read(to, bytes);
        left_ -= bytes;
    }

    std::string take_text(std::uint64_t bytes) {
        if (bytes > left_) refuse("it ends early");
        std::string text(bytes, '\0');
        take(text.data(), bytes);
        return text;
    }

    void check(std::uint64_t place, const std::string& stored, const char* what) {
        if (checksum(place, stored.data(), stored.size()) != take_text(checksum_size))
            refuse(std::string("the checksum of ") + what + " does not match");
    }

    void expand(const std::string& stored, void* to, std::size_t bytes) {
        if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != bytes ||
            ZSTD_decompress(to, bytes, stored.data(), stored.size()) != bytes)
            refuse("what it holds cannot be expanded");
    }
};

Capture CaptureReader::read() {
    Prefix prefix;
    if (left_ < sizeof prefix) refuse("it is no capture, or ends early");
    take(&prefix, sizeof prefix);
    if (std::memcmp(prefix.magic, magic, sizeof magic) != 0) refuse("it is no capture");
    if (prefix.version != version)
        refuse("its version is " + std::to_string(prefix.version) + " and this Triad reads version " +
               std::to_string(version) + "; capture it again");
    if (prefix.header_bytes > most_header || prefix.header_stored > left_ || prefix.contents > most_contents)
        refuse("its header is too large, or it ends early");
    std::vector<Extent> extents(prefix.contents);
    const std::uint64_t head_bytes = prefix.header_stored + extents.size() * sizeof(Extent);
    const std::string head = take_text(head_bytes);
    const std::string whole = std::string(reinterpret_cast<const char*>(&prefix), sizeof prefix) + head;
    check(0, whole, "its header");
    if (!extents.empty())
        std::memcpy(extents.data(), head.data() + prefix.header_stored, extents.size() * sizeof(Extent));

    std::uint64_t all = 0;
    for (const Extent& extent : extents) {
        if (extent.stored > left_) refuse("it ends early");
        if (extent.bytes / most_expansion > extent.stored) refuse("no file of its size holds so much");
        if (__builtin_add_overflow(all, extent.bytes, &all)) refuse("no file of its size holds so much");
    }
    require_memory(all, "What the capture " + path_.string() + " holds");
    std::vector<Recording::Content> contents;
    for (const Extent& extent : extents) {
        const std::string stored = take_text(extent.stored);
        check(contents.size() + 1, stored, "what it holds");
        AlignedVector<std::byte> content(extent.bytes);
        expand(stored, content.data(), content.size());
        contents.push_back(std::make_shared<const AlignedVector<std::byte>>(std::move(content)));
    }
    if (left_ > 0) refuse("bytes follow its end");

    std::string header(prefix.header_bytes, '\0');
    expand(head.substr(0, prefix.header_stored), header.data(), header.size());
    return capture_of_header(
        header,
        [&](std::size_t place) {
            if (place >= contents.size()) refuse("it names a content that it does not have");
            return contents[place];
        },
        [this](const std::string& why) { refuse(why); });
}

}  // namespace

void write_capture(const fs::path& path, const Capture& capture) {
    ContentTable table;
    const std::string header = capture_header(capture, table);
    if (header.size() > most_header || table.contents().size() > most_contents)
        throw Error(Exit::usage,
                    "The pass has too many launches for a capture; take fewer samples or a smaller picture.");
    std::vector<std::string> stored;
    std::vector<Extent> extents;
    for (const Recording::Content& content : table.contents()) {
        stored.push_back(compressed(content->data(), content->size()));
        extents.push_back({stored.back().size(), content->size()});
    }
    const std::string small = compressed(header.data(), header.size());
    Prefix prefix{{}, version, small.size(), header.size(), extents.size()};
    std::memcpy(prefix.magic, magic, sizeof magic);
    const std::string head =
        std::string(reinterpret_cast<const char*>(&prefix), sizeof prefix) + small +
        std::string(reinterpret_cast<const char*>(extents.data()), extents.size() * sizeof(Extent));
    write_file(path, [&](const ByteSink& write) {
        write(head);
        write(checksum(0, head.data(), head.size()));
        for (std::size_t i = 0; i < stored.size(); ++i) {
            write(stored[i]);
            write(checksum(i + 1, stored[i].data(), stored[i].size()));
        }
    });
}

Capture read_capture(const fs::path& path) { return CaptureReader(path).read(); }

}  // namespace triad
