// Who takes what of a list of work, and how films say it.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "base/error.h"
#include "render/undelivered.h"
#include "render/work_share.h"
#include "scene/film.h"
#include "scene/sample_shares.h"
#include "sentence_of.h"
#include "session/prepare.h"

using namespace triad;

namespace {

/// Devices of these speeds (size a second) share a list; every launch costs `overhead` on top. Returns the
/// idle share of the worst, and counts how often each item was taken.
double idle_of(const std::vector<std::uint64_t>& sizes, const std::vector<double>& speeds,
               const std::vector<double>& paces, std::vector<int>& taken) {
    WorkShare share(sizes, paces);
    std::vector<double> busy_until(speeds.size()), known = paces;
    double end = 0;
    for (;;) {
        const std::size_t next =
            std::size_t(std::min_element(busy_until.begin(), busy_until.end()) - busy_until.begin());
        if (known[next] > 0) share.set_pace(next, known[next]);
        const WorkPiece piece = share.take(next, 0.05 * known[next], 100000);
        if (piece.count == 0) break;
        std::uint64_t size = 0;
        for (std::size_t i = piece.first; i < piece.first + piece.count; ++i) ++taken[i], size += sizes[i];
        busy_until[next] += double(size) / speeds[next];
        known[next] = speeds[next];
        end = std::max(end, busy_until[next]);
    }
    EXPECT_TRUE(share.is_done());
    return 1 - *std::min_element(busy_until.begin(), busy_until.end()) / end;
}

}  // namespace

TEST(WorkShare, every_item_is_taken_once_and_no_device_waits) {
    std::mt19937 random(3);
    for (const auto& speeds :
         std::vector<std::vector<double>>{{1e6}, {1e6, 1e6}, {1e6, 3e6}, {1e5, 2e6, 5e5, 7e6}}) {
        std::vector<std::uint64_t> sizes(4000);
        double all = 0;
        for (const double speed : speeds) all += speed;
        for (std::uint64_t& size : sizes)
            size = std::uint64_t(all / 4000 * std::uniform_real_distribution(0.0, 2.0)(random));
        for (const bool known : {true, false}) {
            std::vector<int> taken(sizes.size());
            const double idle =
                idle_of(sizes, speeds, known ? speeds : std::vector<double>(speeds.size()), taken);
            EXPECT_EQ(std::count(taken.begin(), taken.end(), 1), 4000);
            EXPECT_LT(idle, known ? 0.02 : 0.05) << speeds.size();
        }
    }
}

TEST(WorkShare, one_device_takes_all_in_order) {
    WorkShare share({10, 10, 10, 10, 10}, {1000});
    std::size_t at = 0;
    while (!share.is_done()) {
        const WorkPiece piece = share.take(0, 20, 100);
        EXPECT_EQ(piece.first, at);
        EXPECT_EQ(piece.count, std::min<std::size_t>(2, 5 - at));
        at += piece.count;
    }
    EXPECT_EQ(share.take(0, 1000, 100).count, 0u);
}

TEST(WorkShare, most_of_the_list_stays_with_one_device) {
    const std::vector<double> speeds{1e6, 2e6};
    const std::vector<std::uint64_t> sizes(3000, 1000);
    WorkShare share(sizes, speeds);
    EXPECT_EQ(share.take(0, 1e3, 1).first, 0u);
    EXPECT_EQ(share.take(1, 2e3, 1).first, 1000u);
}

TEST(SampleShares, come_back_as_they_were) {
    SampleShares shares(5);
    for (const std::size_t set : {0u, 1u, 2u})
        shares.add(set, 1, 3), shares.add(set, 1, 4), shares.add(set, 0, 2);
    shares.add(4, 0, 7), shares.add(4, 1, 0);
    const std::vector<std::uint32_t> packed = shares.packed();
    EXPECT_EQ(packed, (std::vector<std::uint32_t>{3, 2, 1, 7, 0, 2, 1, 0, 1, 1, 0, 7}));
    SampleShares back = SampleShares::unpacked(packed, 5);
    EXPECT_EQ(back.packed(), packed);
    back.rename(std::vector<std::uint32_t>{4, 0});
    EXPECT_EQ(back.of(0), (std::vector<SampleShares::Run>{{0, 7}, {4, 2}}));
    for (const std::size_t cut : {1u, 3u, 11u})
        sentence_of(Exit::scene, [&] { SampleShares::unpacked(std::span(packed).first(cut), 5); });
    sentence_of(Exit::scene, [&] { SampleShares::unpacked(packed, 4); });
}

TEST(SampleShares, samples_change_hands_and_are_cut) {
    SampleShares shares(1);
    shares.add(0, 0, 10), shares.add(0, 1, 10);
    shares.set(0, 4, 3, 2);
    EXPECT_EQ(shares.of(0), (std::vector<SampleShares::Run>{{0, 4}, {2, 3}, {0, 3}, {1, 10}}));
    shares.set(0, 5, 9, 1);
    EXPECT_EQ(shares.of(0), (std::vector<SampleShares::Run>{{0, 4}, {2, 1}, {1, 15}}));
    shares.cut(0, 7);
    EXPECT_EQ(shares.of(0), (std::vector<SampleShares::Run>{{0, 4}, {2, 1}, {1, 2}}));
    shares.cut(0, 0);
    EXPECT_TRUE(shares.of(0).empty());
}

TEST(Undelivered, work_that_follows_is_joined_and_all_of_it_is_lost_at_once) {
    Undelivered rest(4);
    rest.add({2, {0, 0}, {3, 3}, {}});
    rest.add({2, {3, 3}, {2, 0}, {}});  // adaptive: one set alone
    rest.add({2, {5, 3}, {1, 4}, {}});
    rest.add({2, {9, 7}, {1, 1}, {}});  // another device had the samples between
    rest.add({0, {0, 0}, {1, 1}, {}});
    EXPECT_EQ(rest.samples(8), (SetSamples{1, 1, 0, 0, 7, 8, 0, 0}));
    const auto work = std::make_shared<const TileWorks>(TileWorks{{1, {4, 4}, {1, 1}, {}}});
    rest.add_sample(work, 2);
    const std::vector<LostWork> lost = rest.take();
    ASSERT_EQ(lost.size(), 2u);
    ASSERT_EQ(lost[0].work.size(), 3u);
    EXPECT_FALSE(lost[0].photon_sample.has_value());
    const dev::TileWork& joined = lost[0].work[0];
    EXPECT_EQ(joined.tile, 2u);
    EXPECT_EQ(joined.first_sample[0], 0u);
    EXPECT_EQ(joined.sample_count[0], 6u);
    EXPECT_EQ(joined.sample_count[1], 7u);
    EXPECT_EQ(lost[1].photon_sample, 2u);
    EXPECT_EQ(lost[1].work[0].tile, 1u);
    EXPECT_TRUE(rest.take().empty());
}

TEST(Devices, drivers_of_one_piece_of_hardware_are_found) {
    std::vector<DeviceInfo> devices(5);
    for (const auto& [i, hardware] :
         {std::pair(0, "cpu"), {1, "pci 1:0"}, {2, "cpu"}, {3, "pci 1:0"}, {4, "pci 2:0"}})
        devices[std::size_t(i)].hardware = hardware, devices[std::size_t(i)].usable = i != 3;
    EXPECT_EQ(hardware_of(devices), (std::vector<std::vector<std::size_t>>{{0, 2}, {1}, {4}}));
}
