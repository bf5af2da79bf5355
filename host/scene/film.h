#pragma once
/// The film as plain data: order-free sums over bins. design: docs/architecture.md, "The film".
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace triad {

/// Half-open range of sample indices.
struct SampleRange {
    std::uint64_t begin = 0, end = 0;
    bool operator==(const SampleRange&) const = default;
};

/// How many samples the pixels of a film hold.
struct SampleNumbers {
    std::uint64_t total = 0;
    std::uint32_t least = 0, most = 0;  ///< of a pixel
    double mean = 0;                    ///< per pixel
};

/// What samples of adaptive sampling cost.
struct RoundRays {
    std::uint64_t rays = 0, samples = 0;  ///< of the film, all pixels together, when the round at hand began
    bool by_noise = false;                ///< its samples go where noise is, not everywhere
    double everywhere = 0, noisy = 0;     ///< per sample of the latest round of each kind; 0: none yet
    bool operator==(const RoundRays&) const = default;
};

/// What a render had still to do when its film was kept, so that it goes on as if it had never stopped.
struct FilmProgress {
    std::vector<std::string> words;  ///< of the command line that began it: options that decide the picture
    /// kernel_source::hash() of those that it was rendered with; "several" of more than one; empty: not
    /// known.
    std::string kernels;
    SampleRange samples;  ///< asked for
    bool ended = false;   ///< by the time asked for: nothing is owed
    /// Of each set (SetSamples) at the end of the round at hand; empty: none is planned.
    std::vector<std::uint32_t> wanted;
    /// Samples per pixel and estimated relMSE at the ends of rounds.
    std::vector<std::pair<double, double>> estimates;
    RoundRays rays;
    std::string set_errors;  ///< SetErrorSource::kept()
};

/// Sums of samples in 64-bit fixed point: value = sum / 2^quanta_log2 / samples. Adding films is adding
/// integers, so that merging any parts in any order gives the bytes of one run. Pixels are row-major over the
/// crop.
struct Film {
    unsigned full_width = 0, full_height = 0;      ///< of the picture
    unsigned x = 0, y = 0, width = 0, height = 0;  ///< the crop that this film covers
    unsigned bins_x = 1, bins_y = 1;
    int quanta_log2 = 0;
    std::vector<std::int64_t> sums;       ///< [pixel][bin row-major][R, G, B, alpha]
    std::vector<std::int64_t> half_sums;  ///< [pixel][R, G, B]: samples of the first half only
    std::vector<std::uint32_t> samples;   ///< per pixel, all bins together
    /// [pixel][DENOISE_GUIDES]: what the camera sees first, for denoisers, if has_guides.
    std::vector<float> guides;
    bool has_guides = false;
    /// Sorted, disjoint, coalesced: what every pixel holds. Where sampling was adaptive, pixels go on from
    /// the end of the last range without gaps, as far as `samples` says.
    std::vector<SampleRange> ranges;
    std::array<std::uint64_t, 5> counters{};  ///< COUNTER_* of kernels/types.h
    std::string scene, settings;              ///< hashes; films merge only when both are equal
    std::string settings_text;                ///< JSON of the settings that decide the picture
    std::vector<std::string> devices;         ///< sorted, unique
    /// SampleShares::packed(), where there are several devices; empty: not known.
    std::vector<std::uint32_t> shares;
    std::optional<FilmProgress> progress;  ///< of a film that is not complete

    std::size_t pixels() const { return std::size_t(width) * height; }
    std::size_t bins() const { return std::size_t(bins_x) * bins_y; }
    std::uint64_t sample_count() const;  ///< that every pixel holds: the total length of ranges
    bool is_even() const;                ///< every pixel holds these and no more
    SampleNumbers sample_numbers() const;
};

/// The union of the parts. Throws Error(scene) when they are of different pictures or one is not even,
/// Error(incomplete) when two ranges overlap (the sentence names the range). Holes are no error here: see
/// holes().
Film merge(std::span<const Film> parts);

/// Throws Error(scene) when the films are not of one picture, in words that begin with `what` and say in what
/// they differ.
void require_same_picture(const Film& a, const Film& b,
                          const std::string& what = "The films cannot be merged");

/// merge() without arrays, of films without arrays. `names`: of the parts, for sentences.
Film merged_header(std::span<const Film> parts, std::span<const std::string> names = {});
/// Which of the parts has the earliest samples: guides are its.
std::size_t first_part(std::span<const Film> parts);
/// Throws the Error(scene) of a part whose pixels hold different numbers of samples.
[[noreturn]] void refuse_uneven(const std::string& name);
/// Modulo 2^64: the quantum leaves room for every sum that fits, and order must not matter for those that do
/// not.
void add_sums(std::span<std::int64_t> sums, std::span<const std::int64_t> more);

/// What is missing in [0, end).
std::vector<SampleRange> holes(const Film& film, std::uint64_t end);

/// Mean radiance and alpha of pixel p, averaged over its bins with equal weight per bin.
std::array<double, 4> pixel_mean(const Film& film, std::size_t pixel);

/// Variance of the mean of every pixel, [pixel][R, G, B], estimated without bias from its two halves; empty:
/// not known yet (a half without samples).
std::vector<float> mean_variance(const Film& film);

/// Means of the two halves of every pixel, [pixel][R, G, B]. weight * (first - second) has the variance of
/// the pixel's mean.
struct HalfMeans {
    std::vector<float> first, second;
    std::vector<float> weight;  ///< per pixel: sqrt(nA nB) / (nA + nB)
};
/// None: a half has no samples yet.
std::optional<HalfMeans> half_means(const Film& film);

/// Which pixels around help to estimate r^2: all, or those of the pixel's own set (x ^ y) & 1 of a
/// chessboard, so that nothing of the other set is in the result.
enum class Neighbours { all, own_set };

/// Estimated squared relative error of every pixel: mean over channels of var / (r^2 + 0.01), where var is
/// the variance of the pixel's mean, from its two independently scrambled halves, and r^2 is estimated so
/// that noise in it does not bias the result (docs/film.md). Single pixels are very noisy (one degree of
/// freedom); sums over many are not. Empty: not known yet (a half without samples). Costs tens of nanoseconds
/// per pixel.
std::vector<float> error_map(const Film& film, Neighbours which = Neighbours::all);

/// Estimated relMSE of the picture: the mean of error_map(). Negative: not known yet.
double estimated_relmse(const Film& film);
double estimated_relmse(std::span<const float> error_map);

}  // namespace triad
