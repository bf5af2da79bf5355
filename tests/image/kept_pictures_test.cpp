// Whatever changes the samples, the pictures stay: those of pictures/, which are means of many films of other
// seeds. Every tile and the whole picture are compared; right pictures are called wrong once in a million
// runs of all together. Renewed on purpose by tests/image/update.
#include <gtest/gtest.h>
#include <cstdio>

#include <cmath>
#include <random>

#include "../device/device_fixture.h"
#include "../unit/temporary_folder.h"
#include "io/io.h"
#include "kept_options.h"
#include "kept_picture.h"
#include "kernels/types.h"
#include "metric/statistics.h"
#include "picture_films.h"
#include "render/renderer.h"
#include "session/prepare.h"

namespace triad {

void PrintTo(const KeptCase& c, std::ostream* out) { *out << c.options; }

namespace {

constexpr unsigned spp_kept = 32, films_kept = 40, films_compared = 12;
constexpr std::uint32_t first_kept_seed = 1'000'000, first_compared_seed = 1;
constexpr double family = 1e-6;

struct Rendered {
    KeptPicture picture;
    TileMeans means;
};

/// Films to compare with a kept picture, of as many samples as its own, their left half times `factor`.
Rendered render_to_compare(const KeptCase& c, const KeptPicture& kept, double factor = 1) {
    const unsigned spp = unsigned(std::lround(kept.samples / kept.films));
    KeptPictureMaker maker;
    TileMeans means;
    const bool shared = render_films(c, first_compared_seed, films_compared, spp, [&](Film film) {
        for (std::size_t i = 0; i < film.sums.size() && factor != 1; ++i)
            if (i / FILM_CHANNELS % film.width < film.width / 2)
                film.sums[i] = std::llround(double(film.sums[i]) * factor);
        for (std::size_t i = 0; i < film.half_sums.size() && factor != 1; ++i)
            if (i / 3 % film.width < film.width / 2)
                film.half_sums[i] = std::llround(double(film.half_sums[i]) * factor);
        maker.add(film), means.add(film);
    });
    return {maker.make(shared), means};
}

MeanTest compare(const TileMeans& found, const KeptPicture& kept) {
    return test_means(found, tile_means(kept), sidak(family, kept_cases().size()));
}

/// What is wrong and where, with a picture of the differences in this folder; empty: nothing.
std::string fault(const KeptCase& c, const std::filesystem::path& folder, double factor = 1) {
    const KeptPicture kept = load_kept_picture(kept_picture_file(c.name));
    const Rendered found = render_to_compare(c, kept, factor);
    const MeanTest test = compare(found.means, kept);
    if (test.same) return {};
    const auto map = folder / (c.name + ".exr");
    save_difference(map, found.picture, kept);
    return c.name + ": " + test.sentence + "\nWhere: the layers error.R, G, B of " + map.string();
}

void renew_picture(const KeptCase& c) {
    KeptPictureMaker maker;
    const bool shared =
        render_films(c, first_kept_seed, films_kept, spp_kept, [&](const Film& film) { maker.add(film); });
    const KeptPicture kept = maker.make(shared);
    const auto file = kept_picture_file(c.name);
    const std::string verdict =
        std::filesystem::exists(file) ? compare(tile_means(kept), load_kept_picture(file)).sentence : "new";
    std::printf("    %s: %s\n", c.name.c_str(), verdict.c_str());
    save(file, kept);
}

class KeptPictures : public testing::TestWithParam<KeptCase> {};

TEST_P(KeptPictures, show_what_they_showed) {
    const KeptCase& c = GetParam();
    if (const auto reason = why_not(c.options)) GTEST_SKIP() << *reason;
    if (renewing()) return renew_picture(c);
    EXPECT_EQ(fault(c, std::filesystem::absolute("kept-pictures")), "");
}

INSTANTIATE_TEST_SUITE_P(Table, KeptPictures, testing::ValuesIn(kept_cases()),
                         [](const auto& info) { return info.param.name; });

TEST(KeptPictureFaults, a_half_that_is_two_percent_too_bright_is_found) {
    const TemporaryFolder folder;
    for (const char* name : {"cornell", "page", "knot", "hundred_million", "glass_by_photons"}) {
        const KeptCase& c = kept_case(name);
        if (why_not(c.options)) continue;
        EXPECT_NE(fault(c, folder / "", 1.02), "") << name;
    }
}

TEST(KeptPictureFaults, the_map_shows_where) {
    const TemporaryFolder folder;
    const KeptCase& c = kept_case("knot");
    const std::string said = fault(c, folder / "", 1.1);
    const Picture map = read_picture(said.substr(said.rfind(' ') + 1));
    const std::vector<float>& error = map.find("error.G")->values;
    double left = 0, right = 0;
    for (std::size_t p = 0; p < error.size(); ++p)
        (p % map.width < map.width / 2 ? left : right) += error[p] / double(error.size() / 2);
    EXPECT_GT(left, 1);
    EXPECT_LT(std::abs(right), 0.3);
}

/// Even and without noise of its own, but as bright as chance has it.
Film film_of_shared_noise(std::mt19937& random) {
    Film film{.full_width = 32, .full_height = 32, .width = 32, .height = 32, .quanta_log2 = 20};
    film.ranges = {{0, 2}};
    film.samples.assign(film.pixels(), 2);
    const auto half = std::int64_t(0x1p20 * (1 + 0.1 * std::normal_distribution()(random)));
    film.sums.assign(film.pixels() * FILM_CHANNELS, 2 * half);
    film.half_sums.assign(film.pixels() * 3, half);
    return film;
}

TEST(KeptPictureFaults, noise_that_pixels_share_is_no_fault) {
    std::mt19937 random(1);
    unsigned rejected_shared = 0, rejected = 0;
    for (unsigned run = 0; run < 100; ++run) {
        KeptPictureMaker maker;
        for (unsigned i = 0; i < 20; ++i) maker.add(film_of_shared_noise(random));
        TileMeans found;
        for (unsigned i = 0; i < 4; ++i) found.add(film_of_shared_noise(random));
        rejected_shared += !test_means(found, tile_means(maker.make(true)), 0.05).same;
        rejected += !test_means(found, tile_means(maker.make(false)), 0.05).same;
    }
    EXPECT_LE(rejected_shared, 12u);  // 5 expected
    EXPECT_GE(rejected, 60u);         // with the variances of pixels alone
}

}  // namespace
}  // namespace triad
