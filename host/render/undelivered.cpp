#include "render/undelivered.h"

#include <algorithm>
#include <utility>

namespace triad {

void Undelivered::add(const dev::TileWork& work) {
    std::size_t& latest = latest_[work.tile];
    if (latest > 0) {
        dev::TileWork& last = tiles_[latest - 1];
        bool follows = true;
        for (std::size_t set = 0; set < 2; ++set)
            follows = follows && (work.sample_count[set] == 0 || last.sample_count[set] == 0 ||
                                  last.first_sample[set] + last.sample_count[set] == work.first_sample[set]);
        if (follows) {
            for (std::size_t set = 0; set < 2; ++set) {
                if (last.sample_count[set] == 0) last.first_sample[set] = work.first_sample[set];
                last.sample_count[set] += work.sample_count[set];
            }
            return;
        }
    }
    tiles_.push_back(work);
    latest = tiles_.size();
}

void Undelivered::add_sample(std::shared_ptr<const TileWorks> work, std::uint32_t sample) {
    samples_.push_back({std::move(work), sample});
}

void Undelivered::clear() {
    tiles_.clear(), samples_.clear();
    std::fill(latest_.begin(), latest_.end(), 0);
}

SetSamples Undelivered::samples(std::size_t sets) const {
    SetSamples samples(sets);
    for (const dev::TileWork& w : tiles_)
        for (std::size_t set = 0; set < 2; ++set) samples[2 * w.tile + set] += w.sample_count[set];
    for (const PhotonSample& each : samples_)
        for (const dev::TileWork& w : *each.work)
            for (std::size_t set = 0; set < 2; ++set) samples[2 * w.tile + set] += w.sample_count[set];
    return samples;
}

std::vector<LostWork> Undelivered::take() {
    std::vector<LostWork> lost;
    if (!tiles_.empty()) lost.push_back({tiles_, {}});
    for (const PhotonSample& each : samples_) lost.push_back({*each.work, each.sample});
    clear();
    return lost;
}

}  // namespace triad
