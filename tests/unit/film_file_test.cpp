// Films as files: whole, damaged, and joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "io/io.h"
#include "kernels/types.h"
#include "sentence_of.h"
#include "synthetic_film.h"

using namespace triad;

TEST(FilmFile, comes_back_as_it_was) {
    const TemporaryFolder folder;
    const Film film = merge(std::vector<Film>{synthetic({0, 5}, 3, 1), synthetic({9, 40}, 3, 1)});
    save_film(folder / "a.film", film);
    const Film back = load_film(folder / "a.film");
    EXPECT_EQ(bytes_of(back, folder), read_file(folder / "a.film"));
    EXPECT_EQ(back.sums, film.sums);
    EXPECT_EQ(back.half_sums, film.half_sums);
    EXPECT_EQ(back.samples, film.samples);
    EXPECT_EQ(back.ranges, film.ranges);
    EXPECT_EQ(back.counters, film.counters);
    EXPECT_EQ(back.settings_text, film.settings_text);
    EXPECT_EQ(back.quanta_log2, 30);
    EXPECT_EQ(back.bins_x, 3u);
    EXPECT_EQ(back.bins_y, 1u);
    EXPECT_EQ(back.x, 1u);
    EXPECT_EQ(back.height, 3u);
}

TEST(FilmFile, guides_come_back_and_are_those_of_the_first_samples) {
    const TemporaryFolder folder;
    const auto guided = [](SampleRange range, float value) {
        Film film = synthetic(range);
        film.has_guides = true;
        film.guides.assign(film.pixels() * DENOISE_GUIDES, value);
        film.guides.back() = -value;
        return film;
    };
    const Film early = guided({0, 4}, 1), late = guided({4, 9}, 2), bare = synthetic({9, 11});
    save_film(folder / "early.film", early), save_film(folder / "late.film", late);
    save_film(folder / "bare.film", bare);
    EXPECT_EQ(load_film(folder / "early.film").guides, early.guides);
    merge_films({folder / "bare.film", folder / "late.film", folder / "early.film"}, folder / "all.film");
    const Film all = load_film(folder / "all.film");
    EXPECT_EQ(all.guides, early.guides);
    EXPECT_EQ(read_file(folder / "all.film"), bytes_of(merge(std::vector<Film>{late, bare, early}), folder));
    EXPECT_EQ(all.sums, merge(std::vector<Film>{synthetic({0, 11})}).sums);
    merge_films({folder / "late.film", folder / "bare.film"}, folder / "two.film");
    EXPECT_EQ(load_film(folder / "two.film").guides, late.guides);
}

TEST(FilmFile, every_truncation_is_refused) {
    const TemporaryFolder folder;
    const auto bytes = bytes_of(synthetic({0, 4}), folder);
    const std::string text(bytes.begin(), bytes.end());
    for (std::size_t length = 0; length < text.size(); length += 1 + length / 16) {
        write_file(folder / "cut.film", std::string_view(text).substr(0, length));
        expect_contains(sentence_of(Exit::scene, [&] { load_film(folder / "cut.film"); }), "cut.film");
    }
}

TEST(FilmFile, every_changed_byte_is_refused) {
    const TemporaryFolder folder;
    const auto bytes = bytes_of(synthetic({0, 4}), folder);
    for (std::size_t at = 0; at < bytes.size(); at += 17) {
        std::string text(bytes.begin(), bytes.end());
        text[at] = char(text[at] ^ 0x10);
        write_file(folder / "changed.film", text);
        sentence_of(Exit::scene, [&] { load_film(folder / "changed.film"); });
    }
}

namespace {

/// The file with another header, whose length and checksum are right.
std::string with_header(const std::vector<std::uint8_t>& bytes, const std::string& from,
                        const std::string& to) {
    std::string text(bytes.begin(), bytes.end());
    std::uint64_t length;
    std::memcpy(&length, text.data() + 16, sizeof length);
    std::string header = text.substr(24, length);
    EXPECT_NE(header.find(from), std::string::npos) << header;
    header.replace(header.find(from), from.size(), to);
    const std::uint64_t now = header.size();
    text.replace(24, length + 32, header + Hash().add(header).hex());
    std::memcpy(text.data() + 16, &now, sizeof now);
    return text;
}

}  // namespace

TEST(FilmFile, absurd_sizes_are_refused_before_memory_is_asked_for) {
    const TemporaryFolder folder;
    Film film = synthetic({0, 4});
    film.full_width = film.full_height = 1048576;
    write_file(folder / "huge.film",
               with_header(bytes_of(film, folder), "\"crop\":[1,2,4,3]", "\"crop\":[1,2,1000000,1000000]"));
    expect_contains(sentence_of(Exit::scene, [&] { load_film(folder / "huge.film"); }), "bytes of sums");
    film.progress = FilmProgress{.samples = {0, 8}, .wanted = {1, 2}};
    write_file(folder / "huge.film",
               with_header(bytes_of(film, folder), "\"wanted\":2", "\"wanted\":4611686018427387905"));
    expect_contains(sentence_of(Exit::scene, [&] { load_film(folder / "huge.film"); }), "larger than it is");
}

namespace {

/// A film of three rows of tiles whose pixels have errors, as synthetic().
Film tall_synthetic(SampleRange range) {
    Film film = synthetic(range);
    const std::vector<std::int64_t> sums = film.sums, halves = film.half_sums;
    film.full_height = 24, film.height = 20;
    for (std::size_t i = sums.size(); i < film.pixels() * 4; ++i)
        film.sums.push_back(sums[i % sums.size()] * std::int64_t(1 + i % 5));
    for (std::size_t i = halves.size(); i < film.pixels() * 3; ++i)
        film.half_sums.push_back(halves[i % halves.size()] * std::int64_t(1 + i % 3));
    film.samples.assign(film.pixels(), film.samples[0]);
    return film;
}

}  // namespace

TEST(FilmMerge, of_files_gives_the_bytes_and_the_error_of_a_merge_in_memory) {
    const TemporaryFolder folder;
    for (const unsigned many : {3u, 250u}) {  // more than are kept open
        std::vector<Film> films;
        std::vector<std::filesystem::path> parts;
        for (unsigned i = 0; i < many; ++i) {
            films.push_back(tall_synthetic({3 * ((7 * i) % many), 3 * ((7 * i) % many) + 3}));
            parts.push_back(folder / (std::to_string(i) + ".film"));
            save_film(parts.back(), films.back());
        }
        const MergedFilm merged = merge_films(parts, folder / "merged.film");
        const Film whole = merge(films);
        EXPECT_EQ(read_file(folder / "merged.film"), bytes_of(whole, folder));
        EXPECT_EQ(merged.film.ranges, (std::vector<SampleRange>{{0, 3 * many}}));
        EXPECT_EQ(merged.relmse, estimated_relmse(whole));
        EXPECT_GT(merged.relmse, 0);
    }
}

TEST(FilmMerge, names_what_does_not_fit_and_keeps_the_older_file) {
    const TemporaryFolder folder;
    const auto merging = [&](Exit exit, std::initializer_list<const char*> names) {
        std::vector<std::filesystem::path> parts;
        for (const char* name : names) parts.push_back(folder / name);
        return sentence_of(exit, [&] { merge_films(parts, folder / "m.film"); });
    };
    save_film(folder / "m.film", synthetic({0, 1}));
    const auto before = read_file(folder / "m.film");
    Film stranger = tall_synthetic({9, 12}), uneven = tall_synthetic({9, 12});
    stranger.scene = "another", uneven.samples.back() = 5;
    save_film(folder / "a", tall_synthetic({0, 4}));
    save_film(folder / "b", tall_synthetic({4, 9}));
    save_film(folder / "c", tall_synthetic({7, 12}));
    save_film(folder / "stranger", stranger);
    save_film(folder / "uneven", uneven);
    auto bytes = read_file(folder / "b");
    bytes[bytes.size() / 2] ^= 1;
    write_file(folder / "damaged", std::string(bytes.begin(), bytes.end()));
    const std::string twice = merging(Exit::incomplete, {"a", "b", "c"});
    expect_contains(twice, "7:9 are in " + (folder / "b").string() + " and in " + (folder / "c").string());
    expect_contains(merging(Exit::scene, {"a", "b", "stranger"}), (folder / "stranger").string() + " and ");
    expect_contains(merging(Exit::scene, {"a", "b", "uneven"}), (folder / "uneven").string());
    expect_contains(merging(Exit::scene, {"a", "damaged"}), "rows 8 to 15");
    bytes[bytes.size() - 1] ^= 1;  // and the last rows
    write_file(folder / "twice damaged", std::string(bytes.begin(), bytes.end()));
    expect_contains(merging(Exit::scene, {"a", "twice damaged"}),
                    salvage_film(folder / "twice damaged").damage() + ". triad render --resume ");
    expect_contains(merging(Exit::scene, {"a", "nothing"}), "nothing");
    EXPECT_EQ(read_file(folder / "m.film"), before);
}

TEST(FilmFile, films_of_another_version_are_refused_and_named) {
    const TemporaryFolder folder;
    auto bytes = bytes_of(synthetic({0, 4}), folder);
    bytes[12] = 1;
    write_file(folder / "old.film", std::string(bytes.begin(), bytes.end()));
    expect_contains(sentence_of(Exit::scene, [&] { load_film(folder / "old.film"); }), "its version is 1");
}

TEST(FilmFile, keeps_what_is_still_to_be_done) {
    const TemporaryFolder folder;
    Film film = synthetic({0, 4});
    film.progress = FilmProgress{.words = {"a b.glb", "--seed=3", "\xff"},
                                 .kernels = "0123abc",
                                 .samples = {0, 9},
                                 .ended = true,
                                 .wanted = {4, 6, 8},
                                 .estimates = {{4, 0.1}, {5.3, 1.0 / 3}},
                                 .rays = {12345, 678, true, 3.25, 1.0 / 3},
                                 .set_errors = std::string("a\0b", 3)};
    save_film(folder / "a.film", film);
    const Film back = load_film(folder / "a.film"), header = load_film_header(folder / "a.film");
    ASSERT_TRUE(back.progress && header.progress);
    EXPECT_EQ(back.progress->words.at(1), "--seed=3");
    EXPECT_EQ(header.progress->words, back.progress->words);
    EXPECT_EQ(back.progress->kernels, film.progress->kernels);
    EXPECT_EQ(back.progress->samples, film.progress->samples);
    EXPECT_TRUE(back.progress->ended);
    EXPECT_EQ(back.progress->wanted, film.progress->wanted);
    EXPECT_EQ(back.progress->estimates, film.progress->estimates);
    EXPECT_EQ(back.progress->rays, film.progress->rays);
    EXPECT_EQ(back.progress->set_errors, film.progress->set_errors);
    EXPECT_TRUE(header.sums.empty());
    EXPECT_FALSE(merge(std::vector<Film>{back, synthetic({4, 8})}).progress.has_value());
}

namespace {

/// Three rows of tiles and the progress of a film that is not complete.
Film tall() {
    Film film = synthetic({3, 7});
    film.full_height = 24, film.height = 20;
    film.sums.resize(film.pixels() * 4, 5), film.half_sums.resize(film.pixels() * 3, 2);
    film.samples.resize(film.pixels(), 4);
    film.progress = FilmProgress{.words = {"--seed=3"}, .samples = {3, 9}, .wanted = {6, 6}};
    return film;
}

}  // namespace

TEST(FilmFile, a_changed_byte_costs_the_rows_that_it_hit) {
    const TemporaryFolder folder;
    const Film film = tall();
    const std::string text = [&] {
        const auto bytes = bytes_of(film, folder);
        return std::string(bytes.begin(), bytes.end());
    }();
    std::uint64_t length;
    std::memcpy(&length, text.data() + 16, sizeof length);
    const std::size_t first = 24 + length + 32, row = film.width * (4 * 8 + 3 * 8 + 4), block = 8 * row + 32;
    for (const unsigned hit : {0u, 1u, 2u}) {
        std::string changed = text;
        changed[first + hit * block + 7] ^= 1;
        write_file(folder / "changed.film", changed);
        const std::string sentence = sentence_of(Exit::scene, [&] { load_film(folder / "changed.film"); });
        expect_contains(sentence, "rows " + std::to_string(8 * hit) + " to ");
        expect_contains(sentence, "--resume");
        const SalvagedFilm found = salvage_film(folder / "changed.film");
        const std::pair<unsigned, unsigned> lost{8 * hit, std::min(8 * hit + 8, 20u)};
        EXPECT_EQ(found.lost, (std::vector{lost}));
        EXPECT_TRUE(found.film.ranges.empty());
        EXPECT_EQ(found.film.progress->samples, (SampleRange{3, 9}));
        EXPECT_EQ(found.film.progress->wanted, film.progress->wanted);
        for (std::size_t p = 0; p < film.pixels(); ++p) {
            const bool is_lost = p / film.width >= lost.first && p / film.width < lost.second;
            ASSERT_EQ(found.film.samples[p], is_lost ? 0 : film.samples[p]) << p;
            ASSERT_EQ(found.film.sums[4 * p + 1], is_lost ? 0 : film.sums[4 * p + 1]) << p;
            ASSERT_EQ(found.film.half_sums[3 * p + 2], is_lost ? 0 : film.half_sums[3 * p + 2]) << p;
        }
    }
    std::string swapped = text;  // blocks that are whole, in each other's place
    std::swap_ranges(swapped.begin() + std::ptrdiff_t(first), swapped.begin() + std::ptrdiff_t(first + block),
                     swapped.begin() + std::ptrdiff_t(first + block));
    write_file(folder / "swapped.film", swapped);
    EXPECT_EQ(salvage_film(folder / "swapped.film").lost.size(), 2u);
}

TEST(FilmFile, a_film_that_ends_early_keeps_its_first_rows) {
    const TemporaryFolder folder;
    Film film = tall();
    film.progress.reset();
    const auto bytes = bytes_of(film, folder);
    write_file(folder / "cut.film", std::string(bytes.begin(), bytes.end() - 40));
    const SalvagedFilm found = salvage_film(folder / "cut.film");
    EXPECT_EQ(found.lost, (std::vector<std::pair<unsigned, unsigned>>{{16, 20}}));
    EXPECT_EQ(found.film.progress->samples, (SampleRange{3, 7}));
    EXPECT_TRUE(found.film.progress->words.empty());
    std::string longer(bytes.begin(), bytes.end());
    write_file(folder / "longer.film", longer + "x");
    expect_contains(sentence_of(Exit::scene, [&] { load_film(folder / "longer.film"); }), "follow its end");
}

TEST(FilmFile, damage_of_its_progress_alone_costs_no_samples) {
    const TemporaryFolder folder;
    const auto bytes = bytes_of(tall(), folder);
    write_file(folder / "cut.film", std::string(bytes.begin(), bytes.end() - 1));
    const SalvagedFilm found = salvage_film(folder / "cut.film");
    EXPECT_TRUE(found.lost.empty());
    EXPECT_TRUE(found.lost_progress);
    EXPECT_TRUE(found.film.progress->wanted.empty());
    EXPECT_EQ(found.film.ranges, tall().ranges);
}

TEST(FilmFile, keeps_how_many_samples_each_pixel_has_and_refuses_too_few) {
    const TemporaryFolder folder;
    Film film = synthetic({0, 4});
    film.samples[3] = 40;
    save_film(folder / "uneven.film", film);
    EXPECT_EQ(load_film(folder / "uneven.film").samples, film.samples);
    film.samples[3] = 3;
    save_film(folder / "few.film", film);
    expect_contains(sentence_of(Exit::scene, [&] { load_film(folder / "few.film"); }), "fewer samples");
}

TEST(FilmFile, a_full_disk_is_a_sentence_and_leaves_the_device_alone) {
    if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP();
    expect_contains(sentence_of(Exit::scene, [] { save_film("/dev/full", synthetic({0, 4})); }), "/dev/full");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}
