#include "render/adaptive.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "kernels/types.h"

namespace triad {
namespace {

/// No set is left with less than this share of the mean: what has not been found yet must be looked for
/// everywhere.
constexpr double least_share = 0.25;
/// No set grows by more than this in a round: an estimate from few samples must not draw all of them.
constexpr double most_growth = 4.0;
/// Weights of a tile, of its neighbours by an edge, and by a corner, when a set's error is estimated.
constexpr double weights[3] = {4.0, 1.0, 0.5};
/// Samples go where noise is if the error then falls so many times as steeply: what is foreseen from few
/// samples is more than what comes.
constexpr double worth_it = 1.3;
/// Points of a sequence lie best at powers of two: with n samples, of which P is the greatest, the error
/// falls as n^-1 P^-placement. Measured from 32 to 64: .12 to .25.
constexpr double placement = 0.125;
/// Even samples are judged by a power of two within this factor of the end of the round: the next may go on
/// to it.
constexpr double in_reach = 1.15;

struct Tiles {
    std::size_t across, down;
    explicit Tiles(unsigned width, unsigned height)
        : across((width + FILM_TILE - 1) / FILM_TILE), down((height + FILM_TILE - 1) / FILM_TILE) {}
};

/// The most that a set may hold at the end of a round: a step more, or as many steps as most_growth allows.
std::uint32_t most_after(std::uint32_t have, unsigned step) {
    return have + std::max(1u, unsigned((most_growth - 1) * have / step)) * step;
}

/// The closest to `wanted` of `have`, the most that is allowed, and the numbers between them at which points
/// lie best.
std::uint32_t well_placed(std::uint32_t have, double wanted, unsigned step) {
    const std::uint32_t most = most_after(have, step);
    std::uint32_t best = have;
    const auto offer = [&](std::uint64_t samples) {
        if (samples > have && samples <= most &&
            std::abs(double(samples) - wanted) < std::abs(double(best) - wanted))
            best = std::uint32_t(samples);
    };
    offer(most);
    for (std::uint64_t power = 1; power * step <= most; power *= 2) {
        offer(power * step + have % step);
        if (power > 1) offer((power + power / 2) * step + have % step);
    }
    return best;
}

/// Of a round.
class Planner {
  public:
    Planner(const Tiles& tiles, const std::vector<std::uint32_t>& pixels, const SetErrors& errors,
            const SetSamples& have, double mean, unsigned step)
        : tiles_(tiles), pixels_(pixels), errors_(errors), have_(have), mean_(mean), step_(step) {}

    Distribution where_noise_is() const {
        std::vector<double> share = seen_by_others();
        for (double& value : share) value = std::sqrt(value);
        return {rounded(filled_up(share), true), true};
    }
    Distribution everywhere() const {
        return {rounded(filled_up(std::vector<double>(have_.size(), 1.0)), false), false};
    }

    /// Mean s of a pixel of each set as the other sets of its tile and of the tiles around show it.
    std::vector<double> seen_by_others() const {
        std::vector<double> seen(have_.size());
        for (std::size_t y = 0; y < tiles_.down; ++y)
            for (std::size_t x = 0; x < tiles_.across; ++x)
                for (std::size_t set = 0; set < 2; ++set) {
                    double sum = 0, weight = 0;
                    for (std::size_t v = y - (y > 0); v < std::min(y + 2, tiles_.down); ++v)
                        for (std::size_t u = x - (x > 0); u < std::min(x + 2, tiles_.across); ++u) {
                            const std::size_t other = 2 * (v * tiles_.across + u) + (1 - set);
                            const double w = weights[(v != y) + (u != x)];
                            sum += w * errors_[other], weight += w * pixels_[other];
                        }
                    seen[2 * (y * tiles_.across + x) + set] = weight > 0 ? sum / weight : 0.0;
                }
        return seen;
    }

    /// How steeply the error falls with rays up to these samples: d ln error / d ln rays. A sample costs
    /// `dearer` times what those cost that are there.
    double steepness(const SetSamples& samples, double dearer) const {
        double error = 0, error_now = 0, more = 0, now = 0;
        for (std::size_t i = 0; i < have_.size(); ++i) {
            if (pixels_[i] == 0) continue;
            const int powers = power_below(samples[i]) - power_below(have_[i]);
            error += errors_[i] / samples[i] * std::exp2(-placement * powers);
            error_now += errors_[i] / have_[i];
            more += pixels_[i] * (double(samples[i]) - have_[i]), now += double(pixels_[i]) * have_[i];
        }
        return error > 0 && more > 0 ? std::log(error_now / error) / std::log1p(dearer * more / now) : 0.0;
    }
    /// Of even samples, which gain most where they come to a power of two.
    double steepness_everywhere(const SetSamples& samples) const {
        const double to_samples = steepness(samples, 1);
        const std::uint32_t power = step_ * std::bit_ceil(std::uint32_t(std::ceil(mean_ / step_)));
        if (power > in_reach * mean_) return to_samples;
        SetSamples further = have_;
        for (std::uint32_t& n : further) n = std::max(n, power);
        return std::max(to_samples, steepness(further, 1));
    }

  private:
    const Tiles& tiles_;
    const std::vector<std::uint32_t>& pixels_;
    const SetErrors& errors_;
    const SetSamples& have_;
    const double mean_;
    const unsigned step_;

    /// The exponent of the greatest power of two of steps in them.
    int power_below(std::uint32_t samples) const {
        return int(std::bit_width(std::max(1u, samples / step_))) - 1;
    }

    /// As many samples in proportion to `share` as the mean asks for. Each colour of the chessboard has its
    /// own budget: shared, a set's own samples would decide by way of the sum.
    std::vector<double> filled_up(const std::vector<double>& share) const {
        const auto wanted = [&](std::size_t i, double scale) {
            const double least = std::max(double(have_[i]), least_share * mean_);
            return std::clamp(scale * share[i], least, std::max(least, most_growth * have_[i]));
        };
        std::vector<double> samples(have_.size());
        for (std::size_t colour = 0; colour < 2; ++colour) {
            const auto excess = [&](double scale) {
                double sum = 0;
                for (std::size_t i = colour; i < have_.size(); i += 2)
                    sum += pixels_[i] * (wanted(i, scale) - mean_);
                return sum;
            };
            // Bisection on the logarithm of the scale, over more than any film's range.
            double low = -100, high = 100;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (excess(std::exp2(middle)) < 0 ? low : high) = middle;
            }
            for (std::size_t i = colour; i < have_.size(); i += 2) samples[i] = wanted(i, std::exp2(low));
        }
        return samples;
    }

    SetSamples rounded(const std::vector<double>& wanted, bool by_noise) const {
        SetSamples result = have_;
        for (std::size_t colour = 0; colour < 2; ++colour) {
            std::size_t last = colour;
            for (std::size_t i = colour; i < have_.size(); i += 2)
                if (pixels_[i] > 0) last = i;
            double carry = 0;  // what rounding leaves over goes on to the next set, and in steps to the last
            for (std::size_t i = colour; i < have_.size(); i += 2) {
                if (pixels_[i] == 0) continue;
                carry += pixels_[i] * (wanted[i] - have_[i]);
                const double fit = have_[i] + carry / pixels_[i];
                std::uint32_t& samples = result[i];
                if (by_noise && i != last)
                    samples = well_placed(have_[i], fit, step_);
                else
                    samples +=
                        std::uint32_t(std::max(0.0, std::floor((fit - have_[i]) / step_ + 0.5))) * step_;
                if (by_noise) samples = std::min(samples, most_after(have_[i], step_));
                carry -= double(pixels_[i]) * (samples - have_[i]);
            }
        }
        return result;
    }
};

}  // namespace

SetErrors relmse_of_sets(const Film& film, std::span<const float> errors, const SetSamples& have) {
    if (errors.empty()) return {};
    const Tiles tiles(film.width, film.height);
    SetErrors result(have.size());
    for (std::size_t y = 0; y < film.height; ++y)
        for (std::size_t x = 0; x < film.width; ++x)
            result[2 * (y / FILM_TILE * tiles.across + x / FILM_TILE) + ((x ^ y) & 1)] +=
                errors[y * film.width + x];
    for (std::size_t i = 0; i < have.size(); ++i) result[i] *= have[i];
    return result;
}

Distribution distribute(unsigned width, unsigned height, const SetErrors& errors, const SetSamples& have,
                        double mean, unsigned step, double dearer) {
    const std::vector<std::uint32_t> pixels = set_pixels(width, height);
    const Tiles tiles(width, height);
    const Planner planner(tiles, pixels, errors, have, mean, step);
    Distribution uneven = planner.where_noise_is(), even = planner.everywhere();
    // Sets are asked that did not decide by their own noise: it is no promise of what was chosen for its
    // sake.
    const bool by_noise =
        planner.steepness(uneven.samples, dearer) > worth_it * planner.steepness_everywhere(even.samples);
    Distribution result = std::move(by_noise ? uneven : even);
    if (result.samples == have) {  // less than a step for every set: the noisiest gets one
        const std::vector<double> noise = planner.seen_by_others();
        std::size_t noisiest = 0;
        for (std::size_t i = 1; i < have.size(); ++i)
            if (pixels[i] > 0 && noise[i] > noise[noisiest]) noisiest = i;
        result.samples[noisiest] += step;
    }
    return result;
}

}  // namespace triad
