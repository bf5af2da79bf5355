// Captures as files: what comes back, and what is damaged, of another version, or absurd.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/memory_limit.h"
#include "capture/capture.h"
#include "capture/capture_header.h"
#include "json_schema.h"
#include "kernels/types.h"
#include "sentence_of.h"
#include "temporary_folder.h"

namespace triad {
namespace {

Recording::Content content(std::size_t bytes, unsigned first) {
    AlignedVector<std::byte> values(bytes);
    for (std::size_t i = 0; i < bytes; ++i) values[i] = std::byte(first + i * i);
    return std::make_shared<const AlignedVector<std::byte>>(std::move(values));
}

/// Of a picture of 3 x 2 pixels with two bins each.
Capture small_capture() {
    Capture capture;
    capture.origin = {"0.1.0", "triad capture -o a", "A device", "1.2", "A platform", "OpenCL 1.2", "cpu", 8};
    capture.width = 3, capture.height = 2, capture.bins = 2;
    Recording& work = capture.work;
    work.sources = {{"path/a.cl", "kernel void a(global int* x) { x[0] = 1; }\n", {{"TRIAD_X", "1"}}}};
    work.functions = {{0, "a"}};
    work.memories = {{6 * 2 * 4 * 8, false, nullptr},
                     {6 * 3 * 8, false, nullptr},
                     {6 * 4, false, nullptr},
                     {2 * COUNTERS * 4, false, content(2 * COUNTERS * 4, 3)},
                     {100, true, content(100, 5)}};
    work.argument_lists = {{std::size_t(0), Recording::NoMemory{}, std::string("\x01\xff\0\n", 4)}};
    work.commands = {Recording::FillZero{0}, Recording::Write{4, 90, content(10, 9)},
                     Recording::Launch{0, 0, 64, 0}};
    using What = CapturedArray::What;
    capture.film = {{What::sums, 0, 0, 6, content(6 * 2 * 4 * 8, 1)},
                    {What::half_sums, 1, 0, 6, content(6 * 3 * 8, 2)},
                    {What::samples, 2, 0, 6, content(6 * 4, 4)},
                    {What::counters, 3, 0, 6, content(2 * COUNTERS * 4, 3)}};
    capture.counted = R"({"samples":4})";
    return capture;
}

std::string bytes_of(const Capture& capture, const TemporaryFolder& folder) {
    write_capture(folder / "whole.capture", capture);
    const auto bytes = read_file(folder / "whole.capture");
    return {bytes.begin(), bytes.end()};
}

/// What is said of a file with these bytes.
std::string refused(const TemporaryFolder& folder, const std::string& bytes) {
    write_file(folder / "bad.capture", bytes);
    const std::string sentence = sentence_of(Exit::scene, [&] { read_capture(folder / "bad.capture"); });
    EXPECT_NE(sentence.find("bad.capture"), std::string::npos) << sentence;
    return sentence;
}

/// What is said of a capture that was made as no render makes it, with right checksums.
template <class Change>
std::string refused_when(const Change& change) {
    const TemporaryFolder folder;
    Capture capture = small_capture();
    change(capture);
    return refused(folder, bytes_of(capture, folder));
}

TEST(CaptureFile, comes_back_as_it_was) {
    const TemporaryFolder folder;
    const std::string bytes = bytes_of(small_capture(), folder);
    const Capture back = read_capture(folder / "whole.capture");
    EXPECT_EQ(bytes_of(back, folder), bytes);
    EXPECT_EQ(back.origin.platform_version, "OpenCL 1.2");
    EXPECT_EQ(back.work.sources[0].text, small_capture().work.sources[0].text);
    EXPECT_EQ(back.work.sources[0].options.at("TRIAD_X"), "1");
    EXPECT_EQ(std::get<std::string>(back.work.argument_lists[0][2]), std::string("\x01\xff\0\n", 4));
    EXPECT_TRUE(std::holds_alternative<Recording::NoMemory>(back.work.argument_lists[0][1]));
    EXPECT_EQ(*back.work.memories[4].content, *content(100, 5));
    EXPECT_EQ(back.work.memories[0].content, nullptr);
    EXPECT_EQ(std::get<Recording::Write>(back.work.commands[1]).offset, 90u);
    EXPECT_EQ(*back.film[2].content, *content(6 * 4, 4));
    EXPECT_EQ(back.counted, R"({"samples":4})");
}

TEST(CaptureFile, equal_contents_are_kept_once) {
    const TemporaryFolder folder;
    Capture capture = small_capture();
    AlignedVector<std::byte> noise(1 << 20);
    std::mt19937 random(1);
    for (std::byte& byte : noise) byte = std::byte(random());
    for (int i = 0; i < 3; ++i)
        capture.work.memories.push_back(
            {noise.size(), true, std::make_shared<const AlignedVector<std::byte>>(noise)});
    EXPECT_LT(bytes_of(capture, folder).size(), std::size_t(3) << 19);
}

TEST(CaptureFile, every_truncation_is_refused) {
    const TemporaryFolder folder;
    const std::string bytes = bytes_of(small_capture(), folder);
    for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 32)
        refused(folder, bytes.substr(0, length));
    EXPECT_NE(refused(folder, bytes + "x").find("follow its end"), std::string::npos);
}

TEST(CaptureFile, every_changed_byte_is_refused) {
    const TemporaryFolder folder;
    const std::string bytes = bytes_of(small_capture(), folder);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::string text = bytes;
        text[at] = char(text[at] ^ 0x10);
        refused(folder, text);
    }
}

TEST(CaptureFile, another_version_is_told) {
    const TemporaryFolder folder;
    std::string bytes = bytes_of(small_capture(), folder);
    bytes[12] = 2;
    EXPECT_NE(refused(folder, bytes).find("its version is 2"), std::string::npos);
    EXPECT_NE(
        refused(folder, "glTF and nothing that a capture has, but long enough to be one").find("no capture"),
        std::string::npos);
}

TEST(CaptureFile, absurd_sizes_are_refused_before_memory_is_asked_for) {
    const TemporaryFolder folder;
    const std::string bytes = bytes_of(small_capture(), folder);
    // What the prefix says of its header and of how many contents there are.
    for (const std::size_t at : {16u, 24u, 32u})
        for (const std::uint64_t size : {std::uint64_t(1) << 40, ~std::uint64_t(0), std::uint64_t(1) << 21}) {
            std::string text = bytes;
            std::memcpy(text.data() + at, &size, sizeof size);
            refused(folder, text);
        }
    EXPECT_NE(refused_when([](Capture& c) { c.width = std::uint64_t(1) << 40; }).find("size of its film"),
              std::string::npos);
}

TEST(CaptureFile, has_the_header_that_its_schema_describes) {
    const TemporaryFolder folder;
    ContentTable table;
    std::ofstream(folder / "header") << capture_header(small_capture(), table);
    expect_schema("capture", folder / "header");
}

TEST(CaptureFile, a_header_that_nests_deep_is_refused_before_it_is_written_again) {
    ContentTable table;
    std::string header = capture_header(small_capture(), table);
    const std::string counted = R"({"samples":4})",
                      deep = std::string(100'000, '[') + std::string(100'000, ']');
    header.replace(header.find(counted), counted.size(), deep);
    const auto refuse = [](const std::string& why) { throw Error(Exit::scene, why); };
    const auto content_at = [&](std::size_t place) { return table.contents().at(place); };
    EXPECT_NE(sentence_of(Exit::scene, [&] { capture_of_header(header, content_at, refuse); }).find("nests"),
              std::string::npos);
}

TEST(CaptureFile, contents_that_claim_too_much_are_refused_before_memory_is_asked_for) {
    const TemporaryFolder folder;
    const std::string bytes = bytes_of(small_capture(), folder);
    std::uint64_t header, contents;
    std::memcpy(&header, bytes.data() + 16, sizeof header);
    std::memcpy(&contents, bytes.data() + 32, sizeof contents);
    const std::size_t extents = 40 + header, end = extents + contents * 16;
    /// The first content says that it has so many bytes, and the checksum is right.
    const auto with_size = [&](std::uint64_t size) {
        std::string text = bytes;
        std::memcpy(text.data() + extents + 8, &size, sizeof size);
        text.replace(end, 32, Hash().add_value(std::uint64_t(0)).add(text.data(), end).hex());
        return text;
    };
    EXPECT_NE(refused(folder, with_size(std::uint64_t(1) << 50)).find("no file of its size"),
              std::string::npos);
    EXPECT_NE(refused(folder, with_size(~std::uint64_t(0))).find("no file of its size"), std::string::npos);
    EXPECT_NE(refused(folder, with_size(1 << 20)).find("cannot be expanded"), std::string::npos);
    const std::uint64_t before = memory_limit();
    set_memory_limit(memory_in_use() + (1 << 19));
    write_file(folder / "bad.capture", with_size(1 << 20));
    const std::string sentence = sentence_of(Exit::memory, [&] { read_capture(folder / "bad.capture"); });
    set_memory_limit(before);
    EXPECT_NE(sentence.find("What the capture"), std::string::npos) << sentence;
}

TEST(CaptureFile, places_and_ranges_outside_are_refused) {
    const auto expect = [](const char* words, const auto& change) {
        const std::string sentence = refused_when(change);
        EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
    };
    expect("kernel that it does not have", [](Capture& c) {
        c.work.commands[2] = Recording::Launch{1, 0, 64, 0};
    });
    expect("list of arguments", [](Capture& c) { c.work.commands[2] = Recording::Launch{0, 1, 64, 0}; });
    expect("work-items", [](Capture& c) { c.work.commands[2] = Recording::Launch{0, 0, 0, 0}; });
    expect("buffer that it does not have", [](Capture& c) { c.work.commands[0] = Recording::FillZero{5}; });
    expect("beyond the end", [](Capture& c) {
        c.work.commands[1] = Recording::Write{4, 91, content(10, 9)};
    });
    expect("beyond the end", [](Capture& c) {
        c.work.commands[1] = Recording::Write{4, ~std::uint64_t(0), content(10, 9)};
    });
    expect("buffer that it does not have", [](Capture& c) { c.work.argument_lists[0][0] = std::size_t(99); });
    expect("program that it does not have", [](Capture& c) { c.work.functions[0].source = 1; });
    expect("another size than the buffer", [](Capture& c) { c.work.memories[4].bytes = 101; });
    expect("another size than the film", [](Capture& c) { c.film[0].content = content(8, 1); });
    expect("do not fit together", [](Capture& c) { c.film[2].first_pixel = 1; });
    expect("lacks pixels", [](Capture& c) { c.film.pop_back(); });
    expect("plain path", [](Capture& c) { c.work.sources[0].path = "../../outside.cl"; });
    expect("plain path", [](Capture& c) { c.work.sources[0].path = "/outside.cl"; });
    expect("plain word", [](Capture& c) { c.work.sources[0].options["X"] = "1 -I/etc"; });
}

/// No change of the header may do more than be refused: what is believed of it was checked.
TEST(CaptureFile, random_changes_of_the_header_are_refused_or_harmless) {
    ContentTable table;
    const std::string header = capture_header(small_capture(), table);
    const char* const replacements[] = {
        "-1", "0", "1", "18446744073709551615", "1e30", "null", "[]", "{}", "\"x\"", "true", "255"};
    const auto read = [&](const std::string& text) {
        return capture_of_header(
            text,
            [&](std::size_t place) {
                if (place >= table.contents().size()) throw Error(Exit::scene, "no such content");
                return table.contents()[place];
            },
            [](const std::string& why) { throw Error(Exit::scene, why); });
    };
    ASSERT_NO_THROW(read(header));
    std::mt19937 random(1);
    int kept = 0;
    for (int round = 0; round < 4000; ++round) {
        std::string text = header;
        std::size_t at = text.find_first_of("0123456789", random() % text.size());
        if (round % 8 == 0)
            text[random() % text.size()] = char(random() % 256);
        else if (at != std::string::npos)
            text.replace(at, text.find_first_not_of("0123456789", at) - at,
                         replacements[random() % std::size(replacements)]);
        try {
            read(text);
            ++kept;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::scene);
        }
    }
    EXPECT_GT(kept, 10);
    EXPECT_LT(kept, 3000);
}

}  // namespace
}  // namespace triad
