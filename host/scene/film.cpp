#include "scene/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"

namespace triad {
namespace {

std::string text(const SampleRange& range) {
    return std::to_string(range.begin) + ":" + std::to_string(range.end);
}

}  // namespace

void require_same_picture(const Film& a, const Film& b, const std::string& what) {
    const auto differ = [&](const std::string& in) {
        throw Error(Exit::scene, what + ": they differ in " + in + ".");
    };
    if (a.scene != b.scene) differ("their scene");
    if (a.full_width != b.full_width || a.full_height != b.full_height) differ("the size of the picture");
    if (a.x != b.x || a.y != b.y || a.width != b.width || a.height != b.height)
        differ("the crop that they cover");
    if (a.bins_x != b.bins_x || a.bins_y != b.bins_y) differ("their bins per pixel");
    if (a.quanta_log2 != b.quanta_log2) differ("their fixed-point quantum");
    if (a.settings != b.settings || a.settings_text != b.settings_text) differ("their settings");
}

namespace {

/// Modulo 2^64: the quantum leaves room for every sum that fits, and order must not matter for those that do
/// not.
void add(std::vector<std::int64_t>& sums, const std::vector<std::int64_t>& more) {
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = std::int64_t(std::uint64_t(sums[i]) + std::uint64_t(more[i]));
}

/// The union of disjoint ranges: sorted, touching ones joined. Throws Error(incomplete) where two overlap.
std::vector<SampleRange> join(std::vector<SampleRange> ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::vector<SampleRange> joined;
    for (const SampleRange& range : ranges) {
        if (joined.empty() || range.begin > joined.back().end) {
            joined.push_back(range);
        } else if (range.begin == joined.back().end) {
            joined.back().end = range.end;
        } else {
            const SampleRange twice{range.begin, std::min(range.end, joined.back().end)};
            throw Error(Exit::incomplete,
                        "The films cannot be merged: samples " + text(twice) + " are in two of them.");
        }
    }
    return joined;
}

}  // namespace

std::uint64_t Film::sample_count() const {
    std::uint64_t count = 0;
    for (const SampleRange& range : ranges) count += range.end - range.begin;
    return count;
}

bool Film::is_even() const {
    const std::uint64_t count = sample_count();
    return std::all_of(samples.begin(), samples.end(), [&](std::uint32_t n) { return n == count; });
}

SampleNumbers Film::sample_numbers() const {
    SampleNumbers n;
    if (samples.empty()) return n;
    const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
    n.least = *least, n.most = *most;
    n.total = std::accumulate(samples.begin(), samples.end(), std::uint64_t(0));
    n.mean = double(n.total) / double(samples.size());
    return n;
}

Film merge(std::span<const Film> parts) {
    if (parts.empty()) throw Error(Exit::usage, "There is nothing to merge: name at least one film.");
    Film whole = parts[0];
    for (const Film& part : parts)
        if (parts.size() > 1 && !part.is_even())
            throw Error(
                Exit::scene,
                "The films cannot be merged: the pixels of one hold different numbers of samples (it was "
                "sampled adaptively, or --time ended it within a sample). Render parts of a picture with "
                "--samples, or with --spp and --adaptive off.");
    std::vector<SampleRange> ranges = whole.ranges;
    for (const Film& part : parts.subspan(1)) {
        require_same_picture(whole, part);
        ranges.insert(ranges.end(), part.ranges.begin(), part.ranges.end());
    }
    whole.ranges = join(std::move(ranges));
    if (whole.sample_count() > std::numeric_limits<std::uint32_t>::max())
        throw Error(Exit::scene,
                    "The films cannot be merged: together they have more than 2^32 - 1 samples per pixel.");
    if (parts.size() > 1) whole.progress.reset();  // what a part had still to do is no matter of the whole
    for (const Film& part : parts.subspan(1)) {
        add(whole.sums, part.sums);
        add(whole.half_sums, part.half_sums);
        for (std::size_t p = 0; p < whole.samples.size(); ++p) whole.samples[p] += part.samples[p];
        for (std::size_t c = 0; c < whole.counters.size(); ++c) whole.counters[c] += part.counters[c];
        whole.devices.insert(whole.devices.end(), part.devices.begin(), part.devices.end());
    }
    std::sort(whole.devices.begin(), whole.devices.end());
    whole.devices.erase(std::unique(whole.devices.begin(), whole.devices.end()), whole.devices.end());
    return whole;
}

std::vector<SampleRange> holes(const Film& film, std::uint64_t end) {
    std::vector<SampleRange> missing;
    std::uint64_t at = 0;
    for (const SampleRange& range : film.ranges) {
        if (at < std::min(range.begin, end)) missing.push_back({at, std::min(range.begin, end)});
        at = range.end;
    }
    if (at < end) missing.push_back({at, end});
    return missing;
}

std::array<double, 4> pixel_mean(const Film& film, std::size_t pixel) {
    std::array<double, 4> mean{};
    if (film.samples[pixel] == 0) return mean;
    for (std::size_t bin = 0; bin < film.bins(); ++bin)
        for (std::size_t c = 0; c < 4; ++c) mean[c] += double(film.sums[(pixel * film.bins() + bin) * 4 + c]);
    const double unit = std::ldexp(1.0, -film.quanta_log2) / film.samples[pixel];
    for (double& value : mean) value *= unit;
    return mean;
}

}  // namespace triad
