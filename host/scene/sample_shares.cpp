#include "scene/sample_shares.h"

#include <algorithm>

#include "base/error.h"

namespace triad {

void SampleShares::add(std::size_t set, std::uint32_t device, std::uint32_t samples) {
    if (samples == 0) return;
    std::vector<Run>& runs = runs_[set];
    if (!runs.empty() && runs.back().first == device)
        runs.back().second += samples;
    else
        runs.emplace_back(device, samples);
}

void SampleShares::set(std::size_t set, std::uint32_t first, std::uint32_t count, std::uint32_t device) {
    const std::vector<Run> before = std::move(runs_[set]);
    runs_[set].clear();
    std::uint32_t at = 0;
    for (const auto& [owner, samples] : before) {
        const std::uint32_t end = at + samples, from = std::clamp(first, at, end),
                            to = std::clamp(first + count, at, end);
        add(set, owner, from - at), add(set, device, to - from), add(set, owner, end - to);
        at = end;
    }
}

void SampleShares::cut(std::size_t set, std::uint32_t samples) {
    const std::vector<Run> before = std::move(runs_[set]);
    runs_[set].clear();
    for (const auto& [owner, count] : before) {
        add(set, owner, std::min(count, samples));
        samples -= std::min(count, samples);
    }
}

void SampleShares::rename(std::span<const std::uint32_t> to) {
    for (std::vector<Run>& runs : runs_)
        for (auto& [device, samples] : runs)
            if (device < to.size()) device = to[device];
}

std::vector<std::uint32_t> SampleShares::packed() const {
    std::vector<std::uint32_t> packed;
    for (std::size_t first = 0, end; first < runs_.size(); first = end) {
        for (end = first + 1; end < runs_.size() && runs_[end] == runs_[first];) ++end;
        packed.push_back(std::uint32_t(end - first));
        packed.push_back(std::uint32_t(runs_[first].size()));
        for (const auto& [device, samples] : runs_[first])
            packed.push_back(device), packed.push_back(samples);
    }
    return packed;
}

SampleShares SampleShares::unpacked(std::span<const std::uint32_t> packed, std::size_t sets) {
    SampleShares shares(sets);
    std::size_t at = 0, set = 0;
    const auto refuse = [] {
        throw Error(Exit::scene, "The film cannot be used: which device took which samples is damaged.");
    };
    while (at < packed.size()) {
        if (packed.size() - at < 2) refuse();
        const std::size_t same = packed[at], runs = packed[at + 1];
        at += 2;
        if (same == 0 || same > sets - set || runs > (packed.size() - at) / 2) refuse();
        for (std::size_t i = 0; i < runs; ++i) shares.add(set, packed[at + 2 * i], packed[at + 2 * i + 1]);
        for (std::size_t i = 1; i < same; ++i) shares.runs_[set + i] = shares.runs_[set];
        at += 2 * runs, set += same;
    }
    if (set != sets) refuse();
    return shares;
}

}  // namespace triad
