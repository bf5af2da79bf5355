// The film as integers, and its file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "io/io.h"
#include "scene/film.h"
#include "sentence_of.h"
#include "temporary_folder.h"

using namespace triad;

namespace {

/// What a renderer would make: sample s of pixel p has a value that depends on (p, s) alone.
Film synthetic(SampleRange range, unsigned bins_x = 1, unsigned bins_y = 1) {
    Film film;
    film.full_width = 7, film.full_height = 5;
    film.x = 1, film.y = 2, film.width = 4, film.height = 3;
    film.bins_x = bins_x, film.bins_y = bins_y;
    film.quanta_log2 = 30;
    const std::size_t bins = film.bins();
    film.sums.assign(film.pixels() * bins * 4, 0);
    film.half_sums.assign(film.pixels() * 3, 0);
    film.samples.assign(film.pixels(), std::uint32_t(range.end - range.begin));
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (std::uint64_t s = range.begin; s < range.end; ++s)
            for (std::size_t c = 0; c < 4; ++c) {
                const auto value = std::int64_t((p * 7919 + s * 104729 + c * 1299709) % 1000003) << 12;
                film.sums[(p * bins + s % bins) * 4 + c] += value;
                if (c < 3 && ((s / bins) & 1) == 0) film.half_sums[p * 3 + c] += value;
            }
    film.ranges = {range};
    film.counters = {range.end - range.begin, 1, 0, 2, 3};
    film.scene = "00112233445566778899aabbccddeeff";
    film.settings = "ffeeddccbbaa99887766554433221100";
    film.settings_text = "{\"seed\": 1}";
    film.devices = {"some device"};
    return film;
}

std::vector<std::uint8_t> bytes_of(const Film& film, const TemporaryFolder& folder) {
    save_film(folder / "bytes.film", film);
    return read_file(folder / "bytes.film");
}

void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

}  // namespace

TEST(Film, three_uneven_ranges_in_any_order_give_the_bytes_of_one_run) {
    const TemporaryFolder folder;
    std::vector<Film> parts{synthetic({0, 5}, 3, 3), synthetic({5, 6}, 3, 3), synthetic({6, 37}, 3, 3)};
    Film whole = synthetic({0, 37}, 3, 3);
    whole.counters = {37, 3, 0, 6, 9};
    const auto expected = bytes_of(whole, folder);
    std::array<std::size_t, 3> order{0, 1, 2};
    do {
        const std::vector<Film> shuffled{parts[order[0]], parts[order[1]], parts[order[2]]};
        EXPECT_EQ(bytes_of(merge(shuffled), folder), expected);
        const std::vector<Film> later{merge(std::vector<Film>{shuffled[0], shuffled[1]}), shuffled[2]};
        EXPECT_EQ(bytes_of(merge(later), folder), expected);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Film, merging_the_same_samples_twice_is_refused_and_named) {
    const std::vector<Film> parts{synthetic({0, 8}), synthetic({6, 9})};
    expect_contains(sentence_of(Exit::incomplete, [&] { merge(parts); }), "6:8");
}

TEST(Film, merging_different_pictures_is_refused) {
    for (const auto& [change, word] : std::initializer_list<std::pair<void (*)(Film&), const char*>>{
             {[](Film& f) { f.scene = "x"; }, "scene"},
             {[](Film& f) { f.settings = "x"; }, "settings"},
             {[](Film& f) { f.quanta_log2 = 20; }, "quantum"},
             {[](Film& f) { f.x = 0; }, "crop"},
             {[](Film& f) { f.full_width = 8; }, "size"}}) {
        std::vector<Film> parts{synthetic({0, 2}), synthetic({2, 4})};
        change(parts[1]);
        expect_contains(sentence_of(Exit::scene, [&] { merge(parts); }), word);
    }
}

TEST(Film, adaptive_films_do_not_merge_and_say_why) {
    std::vector<Film> parts{synthetic({0, 2}), synthetic({2, 4})};
    parts[0].samples[3] = 4;
    expect_contains(sentence_of(Exit::scene, [&] { merge(parts); }), "adaptively");
    EXPECT_EQ(merge(std::span<const Film>(parts.data(), 1)).samples, parts[0].samples);
}

TEST(Film, sample_numbers_are_those_of_its_pixels) {
    Film film = synthetic({0, 4});
    EXPECT_TRUE(film.is_even());
    film.samples[3] = 16;
    EXPECT_FALSE(film.is_even());
    const SampleNumbers n = film.sample_numbers();
    EXPECT_EQ(n.least, 4u);
    EXPECT_EQ(n.most, 16u);
    EXPECT_EQ(n.total, 60u);
    EXPECT_DOUBLE_EQ(n.mean, 5.0);
}

TEST(Film, devices_are_sorted_and_unique_after_a_merge) {
    std::vector<Film> parts{synthetic({0, 2}), synthetic({2, 4}), synthetic({4, 5})};
    parts[0].devices = {"b"}, parts[1].devices = {"a"}, parts[2].devices = {"b"};
    EXPECT_EQ(merge(parts).devices, (std::vector<std::string>{"a", "b"}));
}

TEST(Film, holes_are_what_is_missing_below_the_end) {
    const std::vector<Film> parts{synthetic({2, 5}), synthetic({7, 8})};
    const Film film = merge(parts);
    EXPECT_EQ(film.sample_count(), 4u);
    EXPECT_EQ(holes(film, 10), (std::vector<SampleRange>{{0, 2}, {5, 7}, {8, 10}}));
    EXPECT_EQ(holes(film, 6), (std::vector<SampleRange>{{0, 2}, {5, 6}}));
    EXPECT_EQ(holes(film, 1), (std::vector<SampleRange>{{0, 1}}));
    EXPECT_TRUE(holes(synthetic({0, 4}), 4).empty());
}

TEST(Film, pixel_mean_is_the_mean_of_its_samples) {
    const Film film = synthetic({0, 18}, 3, 3);
    double sum = 0;
    for (std::uint64_t s = 0; s < 18; ++s)
        sum += double((5 * 7919 + s * 104729 + 2 * 1299709) % 1000003) * 4096.0;
    EXPECT_DOUBLE_EQ(pixel_mean(film, 5)[2], sum / 18.0 / double(1u << 30));
}

TEST(Film, pixel_mean_without_samples_is_black) {
    Film film = synthetic({0, 1});
    film.samples[3] = 0;
    EXPECT_EQ(pixel_mean(film, 3), (std::array<double, 4>{}));
}

namespace {

/// A picture with edges, texture and a gradient, whose samples are gamma-distributed: relative variance 2.5
/// each, and skewed as radiance is. Returns estimated over true relMSE.
double relmse_ratio(unsigned samples, unsigned seed) {
    constexpr double shape = 0.4;
    Film film;
    film.full_width = film.width = 40, film.full_height = film.height = 30;
    film.quanta_log2 = 30;
    film.ranges = {{0, samples}};
    film.samples.assign(film.pixels(), samples);
    std::mt19937 random(seed);
    const unsigned half = (samples + 1) / 2;
    double error = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const double x = double(p % 40), y = double(p / 40);
        const double truth = x < 20 ? 0.02 + 0.02 * y : (y < 15 ? 2.0 : 0.4 * (1.2 + std::sin(0.8 * x)));
        for (int c = 0; c < 4; ++c) {
            const double a = truth / shape * std::gamma_distribution<double>(half * shape)(random);
            const double b =
                truth / shape * std::gamma_distribution<double>((samples - half) * shape)(random);
            film.sums.push_back(std::llround(std::ldexp(a + b, 30)));
            if (c < 3) film.half_sums.push_back(std::llround(std::ldexp(a, 30)));
            const double mean = (a + b) / samples;
            if (c < 3) error += (mean - truth) * (mean - truth) / (truth * truth + 0.01);
        }
    }
    return estimated_relmse(film) / (error / (3.0 * double(film.pixels())));
}

}  // namespace

// The median over 100 seeds; its own spread is about 1 %. Fewer than 16 such samples look a little worse than
// they are.
TEST(FilmError, estimate_is_right_within_a_tenth_from_16_samples_on) {
    for (const unsigned samples : {4u, 5u, 7u, 16u, 64u, 1024u}) {
        std::vector<double> ratios;
        for (unsigned seed = 0; seed < 100; ++seed) ratios.push_back(relmse_ratio(samples, seed));
        std::nth_element(ratios.begin(), ratios.begin() + 50, ratios.end());
        EXPECT_GT(ratios[50], 0.9) << samples;
        EXPECT_LT(ratios[50], samples < 16 ? 1.2 : 1.1) << samples;
    }
}

// A pixel that went on has more samples in each half; its variance is counted by its own numbers.
TEST(FilmError, uneven_pixels_are_measured_by_their_own_halves) {
    for (const unsigned bins : {1u, 2u}) {
        const Film even = synthetic({3, 3 + 8 * bins}, bins), longer = synthetic({3, 3 + 13 * bins}, bins);
        Film film = even;
        const std::size_t p = 6, n = 4 * bins;
        std::copy_n(longer.sums.begin() + p * n, n, film.sums.begin() + p * n);
        std::copy_n(longer.half_sums.begin() + p * 3, 3, film.half_sums.begin() + p * 3);
        film.samples[p] = longer.samples[p];
        const auto found = mean_variance(film), at_even = mean_variance(even),
                   at_longer = mean_variance(longer);
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_EQ(found[i], i / 3 == p ? at_longer[i] : at_even[i]) << i;
    }
}

TEST(FilmError, the_map_of_one_set_reads_nothing_of_the_other) {
    const Film film = synthetic({0, 8});
    Film changed = film;
    for (std::size_t p = 0; p < film.pixels(); ++p)
        if ((p % 4 ^ p / 4) & 1)
            for (std::size_t c = 0; c < 3; ++c)
                changed.sums[p * 4 + c] *= 3, changed.half_sums[p * 3 + c] *= 2;
    const auto before = error_map(film, Neighbours::own_set), after = error_map(changed, Neighbours::own_set);
    unsigned differ = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p)
        if ((p % 4 ^ p / 4) & 1)
            differ += before[p] != after[p];
        else
            EXPECT_EQ(before[p], after[p]) << p;
    EXPECT_GT(differ, 0u);
    EXPECT_NE(error_map(film)[0], error_map(changed)[0]);
}

TEST(FilmError, is_the_mean_of_its_map) {
    const Film film = synthetic({0, 8});
    double sum = 0;
    for (const float e : error_map(film)) sum += e;
    EXPECT_DOUBLE_EQ(estimated_relmse(film), sum / double(film.pixels()));
}

TEST(FilmError, is_unknown_while_a_half_is_empty) {
    EXPECT_LT(estimated_relmse(synthetic({0, 1})), 0.0);
    EXPECT_LT(estimated_relmse(synthetic({0, 9}, 3, 3)),
              0.0);  // nine bins: the first nine samples are one half
    EXPECT_GT(estimated_relmse(synthetic({0, 10}, 3, 3)), 0.0);
}

TEST(FilmError, equal_halves_have_no_error) {
    Film film = synthetic({0, 2});
    for (std::size_t p = 0; p < film.pixels(); ++p)
        for (std::size_t c = 0; c < 3; ++c)
            film.half_sums[p * 3 + c] = (film.sums[p * 4 + c] &= ~std::int64_t(1)) / 2;
    EXPECT_EQ(estimated_relmse(film), 0.0);
}

TEST(FilmError, a_single_pixel_is_measured_against_itself) {
    Film film;
    film.full_width = film.width = film.full_height = film.height = 1;
    film.quanta_log2 = 10;
    film.ranges = {{0, 2}};
    film.samples = {2};
    film.sums = {4096, 4096, 4096, 2048};  // halves 1 and 3: mean 2, variance of the mean 1
    film.half_sums = {1024, 1024, 1024};
    EXPECT_NEAR(estimated_relmse(film), 1 / 4.01, 1e-7);
}

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
                                 .samples = {0, 9},
                                 .ended = true,
                                 .wanted = {4, 6, 8},
                                 .estimates = {{4, 0.1}, {5.3, 1.0 / 3}},
                                 .set_errors = std::string("a\0b", 3)};
    save_film(folder / "a.film", film);
    const Film back = load_film(folder / "a.film"), header = load_film_header(folder / "a.film");
    ASSERT_TRUE(back.progress && header.progress);
    EXPECT_EQ(back.progress->words.at(1), "--seed=3");
    EXPECT_EQ(header.progress->words, back.progress->words);
    EXPECT_EQ(back.progress->samples, film.progress->samples);
    EXPECT_TRUE(back.progress->ended);
    EXPECT_EQ(back.progress->wanted, film.progress->wanted);
    EXPECT_EQ(back.progress->estimates, film.progress->estimates);
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
