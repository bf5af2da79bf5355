// Is the error that a picture is said to have the error that it has?
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "picture_films.h"
#include "scene/film.h"

namespace triad {
namespace {

constexpr unsigned seeds = 20, spp = 16;

/// Between which values the median of estimated over true error lies, and how many of the seeds are within a
/// factor of 1.3. A tenth, and nine of ten, but where `why` says what 16 samples cannot know.
struct EstimateCase {
    const char* picture;
    double least = 0.9, most = 1.1, within = 0.9;
    const char* why = "";
};
void PrintTo(const EstimateCase& c, std::ostream* out) { *out << c.picture; }

/// relMSE of `film` against the kept picture, less what the noise of the latter adds.
double true_relmse(const Film& film, const KeptPicture& kept) {
    double sum = 0;
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const auto mean = pixel_mean(film, p);
        for (std::size_t c = 0; c < 3; ++c) {
            const double r = kept.mean[3 * p + c], d = mean[c] - r;
            sum += (d * d - kept.variance[3 * p + c]) / (r * r + 0.01);
        }
    }
    return sum / (3.0 * double(film.pixels()));
}

class ErrorEstimate : public testing::TestWithParam<EstimateCase> {};

TEST_P(ErrorEstimate, is_the_true_error) {
    const EstimateCase& c = GetParam();
    const KeptPicture kept = load_kept_picture(kept_picture_file(c.picture));
    std::vector<double> ratios;
    render_films(kept_case(c.picture), 1, seeds, spp, [&](const Film& film) {
        ratios.push_back(estimated_relmse(film) / true_relmse(film, kept));
    });
    std::sort(ratios.begin(), ratios.end());
    const double median = (ratios[seeds / 2 - 1] + ratios[seeds / 2]) / 2;
    EXPECT_GT(median, c.least) << c.why;
    EXPECT_LT(median, c.most) << c.why;
    const auto close =
        std::count_if(ratios.begin(), ratios.end(), [](double r) { return r > 1 / 1.3 && r < 1.3; });
    EXPECT_GE(double(close), c.within * seeds)
        << "least " << ratios.front() << ", most " << ratios.back() << c.why;
}

const char* const rare =
    "Light that a pixel's 16 samples find once or never: nothing in the film says whether the "
    "pixel is bright or the sample rare.";

INSTANTIATE_TEST_SUITE_P(Suite, ErrorEstimate,
                         testing::Values(EstimateCase{"built_in"}, EstimateCase{"cornell"},
                                         EstimateCase{"knot"}, EstimateCase{"metals", 0.85},
                                         EstimateCase{"corridor"}, EstimateCase{"glass", 0.9, 1.4, 0.4, rare},
                                         EstimateCase{"plates", 0.9, 1.6, 0.15, rare},
                                         EstimateCase{"lamps", 0.9, 2.6, 0.15, rare},
                                         EstimateCase{"garden", 0.9, 1.25, 0.6, rare},
                                         EstimateCase{"rotunda", 0.8, 1.3, 0.5, rare}),
                         [](const auto& info) { return std::string(info.param.picture); });

}  // namespace
}  // namespace triad
