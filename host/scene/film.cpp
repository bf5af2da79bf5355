#include "scene/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "scene/film_sets.h"
#include "scene/sample_shares.h"

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

/// A range, and the place of its film among the parts.
struct PartRange {
    SampleRange range;
    std::size_t part;
};

/// The union of disjoint ranges: sorted, touching ones joined. Throws Error(incomplete) where two overlap.
std::vector<SampleRange> join(std::vector<PartRange> ranges, std::span<const std::string> names) {
    std::sort(ranges.begin(), ranges.end(),
              [](const auto& a, const auto& b) { return a.range.begin < b.range.begin; });
    const auto name = [&](const PartRange& of) { return names.empty() ? "another" : names[of.part]; };
    std::vector<SampleRange> joined;
    const PartRange* furthest = nullptr;
    for (const PartRange& next : ranges) {
        const SampleRange& range = next.range;
        if (joined.empty() || range.begin > joined.back().end) {
            joined.push_back(range);
        } else if (range.begin == joined.back().end) {
            joined.back().end = range.end;
        } else {
            const SampleRange twice{range.begin, std::min(range.end, furthest->range.end)};
            throw Error(Exit::incomplete, "The films cannot be merged: samples " + text(twice) + " are in " +
                                              (names.empty() ? "one" : name(*furthest)) + " and in " +
                                              name(next) + ".");
        }
        furthest = &next;
    }
    return joined;
}

/// Every set has the samples of every part, in the order of the ranges.
std::vector<std::uint32_t> shares_of(std::vector<PartRange> ranges, std::span<const Film> parts,
                                     const Film& whole) {
    std::sort(ranges.begin(), ranges.end(),
              [](const auto& a, const auto& b) { return a.range.begin < b.range.begin; });
    SampleShares shares(1);
    for (const auto& [range, part] : ranges) {
        const std::vector<std::string>& devices = parts[part].devices;
        const auto place =
            devices.size() == 1
                ? std::uint32_t(std::find(whole.devices.begin(), whole.devices.end(), devices[0]) -
                                whole.devices.begin())
                : SampleShares::several;
        shares.add(0, place, std::uint32_t(range.end - range.begin));
    }
    std::vector<std::uint32_t> packed = shares.packed();
    packed[0] = std::uint32_t(2 * tile_count(whole.width, whole.height));
    return packed;
}

}  // namespace

void add_sums(std::span<std::int64_t> sums, std::span<const std::int64_t> more) {
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = std::int64_t(std::uint64_t(sums[i]) + std::uint64_t(more[i]));
}

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

void refuse_uneven(const std::string& name) {
    throw Error(
        Exit::scene,
        "The films cannot be merged: the pixels of " + name +
            " hold different numbers of samples (it was sampled adaptively, or stopped within a sample). "
            "Render parts of a picture with --samples, or with --spp and --adaptive off.");
}

std::size_t first_part(std::span<const Film> parts) {
    const auto begin = [](const Film& part) {
        return part.ranges.empty() ? std::numeric_limits<std::uint64_t>::max() : part.ranges[0].begin;
    };
    return std::size_t(std::min_element(parts.begin(), parts.end(),
                                        [&](const Film& a, const Film& b) { return begin(a) < begin(b); }) -
                       parts.begin());
}

Film merged_header(std::span<const Film> parts, std::span<const std::string> names) {
    if (parts.empty()) throw Error(Exit::usage, "There is nothing to merge: name at least one film.");
    Film whole;
    whole.full_width = parts[0].full_width, whole.full_height = parts[0].full_height;
    whole.x = parts[0].x, whole.y = parts[0].y, whole.width = parts[0].width, whole.height = parts[0].height;
    whole.bins_x = parts[0].bins_x, whole.bins_y = parts[0].bins_y;
    whole.quanta_log2 = parts[0].quanta_log2;
    whole.scene = parts[0].scene, whole.settings = parts[0].settings;
    whole.settings_text = parts[0].settings_text;
    if (parts.size() == 1) whole.progress = parts[0].progress;  // what one of several had to do is nobody's
    whole.has_guides = parts[first_part(parts)].has_guides;
    std::vector<PartRange> ranges;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        require_same_picture(whole, parts[i],
                             names.empty() ? "The films cannot be merged"
                                           : names[i] + " and " + names[0] + " cannot be merged");
        for (const SampleRange& range : parts[i].ranges) ranges.push_back({range, i});
        for (std::size_t c = 0; c < whole.counters.size(); ++c) whole.counters[c] += parts[i].counters[c];
        whole.devices.insert(whole.devices.end(), parts[i].devices.begin(), parts[i].devices.end());
    }
    whole.ranges = join(ranges, names);
    if (whole.sample_count() > std::numeric_limits<std::uint32_t>::max())
        throw Error(Exit::scene,
                    "The films cannot be merged: together they have more than 2^32 - 1 samples per pixel.");
    std::sort(whole.devices.begin(), whole.devices.end());
    whole.devices.erase(std::unique(whole.devices.begin(), whole.devices.end()), whole.devices.end());
    if (parts.size() == 1)
        whole.shares = parts[0].shares;
    else if (whole.devices.size() > 1)
        whole.shares = shares_of(std::move(ranges), parts, whole);
    return whole;
}

Film merge(std::span<const Film> parts) {
    Film whole = merged_header(parts);
    whole.sums = parts[0].sums, whole.half_sums = parts[0].half_sums, whole.samples = parts[0].samples;
    whole.guides = parts[first_part(parts)].guides;
    for (const Film& part : parts)
        if (parts.size() > 1 && !part.is_even()) refuse_uneven("one");
    for (const Film& part : parts.subspan(1)) {
        add_sums(whole.sums, part.sums);
        add_sums(whole.half_sums, part.half_sums);
        for (std::size_t p = 0; p < whole.samples.size(); ++p) whole.samples[p] += part.samples[p];
    }
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
