// The methods of reconstruction: what each is made of, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/error.h"
#include "display/reconstruction.h"

using namespace triad;

namespace {

PanelView view(const std::string& name) { return {*builtin_panel(name), 45}; }

Reconstruction made(const std::string& method, const std::string& panel = "") {
    ReconstructionChoice choice;
    choice.method = method;
    if (!panel.empty()) choice.panel = view(panel);
    return reconstruction_of(choice);
}

void expect_bins(const Reconstruction& r, unsigned x, unsigned y) {
    EXPECT_EQ(r.bins_x, x) << r.method;
    EXPECT_EQ(r.bins_y, y) << r.method;
    if (r.taps) {
        EXPECT_EQ(r.taps->bins_x, x) << r.method;
        EXPECT_EQ(r.taps->bins_y, y) << r.method;
    }
}

}  // namespace

TEST(Reconstruction, methods_are_the_triples_of_the_table) {
    const Reconstruction none = made("");
    expect_bins(none, 1, 1);
    EXPECT_FALSE(none.taps || none.display_linear());
    const Reconstruction centre = made("centre");
    expect_bins(centre, 1, 1);
    EXPECT_EQ(centre.ray_start, RayStart::centre);
    const Reconstruction ssaa = made("ssaa:5");
    expect_bins(ssaa, 5, 5);
    EXPECT_EQ(ssaa.ray_start, RayStart::centre);
    EXPECT_EQ(ssaa.order, ToneOrder::per_pixel);
    EXPECT_FALSE(ssaa.display_linear());
    expect_bins(made("pane"), 4, 4);
    expect_bins(made("pane:2"), 2, 2);
    EXPECT_EQ(made("pane:2").order, ToneOrder::per_bin);
    EXPECT_TRUE(made("pane:2").display_linear());
    EXPECT_EQ(made("pane-encoded").order, ToneOrder::per_bin_encoded);
    const Reconstruction triad = made("triad", "qd-oled");
    expect_bins(triad, 3, 3);
    EXPECT_TRUE(triad.refine && triad.taps && triad.panel && triad.display_linear());
    EXPECT_EQ(triad.ray_start, RayStart::jitter);
    EXPECT_EQ(triad.order, ToneOrder::noise_aware);
    ReconstructionChoice choice;
    choice.panel = view("rgb");
    EXPECT_EQ(reconstruction_of(choice).method, "triad");
    choice.filter = PixelFilter{};
    EXPECT_EQ(reconstruction_of(choice).method, "filter");
}

TEST(Reconstruction, three_rays_give_each_emitter_the_ray_at_its_place) {
    const auto firsts = [](const std::string& panel) {
        const Reconstruction r = made("subpixel3", panel);
        std::vector<int> first;
        for (unsigned c = 0; c < 3; ++c)
            first.push_back(r.bins_x == 3 ? r.taps->of(0, 0, c).first_x : r.taps->of(0, 0, c).first_y);
        return first;
    };
    EXPECT_EQ(firsts(""), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(firsts("rgb"), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(firsts("bgr"), (std::vector<int>{2, 1, 0}));
    EXPECT_EQ(firsts("vbgr"), (std::vector<int>{2, 1, 0}));
    expect_bins(made("subpixel3", "vrgb"), 1, 3);
    EXPECT_EQ(made("subpixel3").ray_start, RayStart::centre);
}

TEST(Reconstruction, a_displaced_box_filter_is_the_displaced_box) {
    for (const char* panel : {"rgb", "bgr", "vrgb", "qd-oled", "pentile", "woled"}) {
        ReconstructionChoice choice;
        choice.panel = view(panel);
        choice.filter = PixelFilter{};
        const TapTable a = *reconstruction_of(choice).taps, b = *made("displaced", panel).taps;
        ASSERT_EQ(a.outputs.size(), b.outputs.size()) << panel;
        for (std::size_t i = 0; i < a.outputs.size(); ++i) {
            EXPECT_EQ(a.outputs[i].first_x, b.outputs[i].first_x) << panel;
            EXPECT_EQ(a.outputs[i].first_y, b.outputs[i].first_y) << panel;
            ASSERT_EQ(a.outputs[i].weights.size(), b.outputs[i].weights.size()) << panel;
            for (std::size_t k = 0; k < a.outputs[i].weights.size(); ++k)
                EXPECT_NEAR(a.outputs[i].weights[k], b.outputs[i].weights[k], 1e-6) << panel;
        }
    }
}

TEST(Reconstruction, rays_by_a_filter_leave_nothing_for_taps_but_their_own_bin) {
    const Reconstruction separate = made("random3", "rgb"), shared = made("random3:shared", "rgb");
    expect_bins(separate, 3, 1);
    expect_bins(shared, 1, 1);
    for (const Reconstruction& r : {separate, shared}) {
        EXPECT_EQ(r.ray_start, RayStart::filter);
        EXPECT_EQ(r.order, ToneOrder::per_pixel);
        ASSERT_EQ(r.ray_filter.outputs.size(), 3u);
        const auto& w = r.ray_filter.outputs[0].weights;
        EXPECT_LT(*std::min_element(w.begin(), w.end()), 0.0f) << "signed lobes";
    }
    for (unsigned c = 0; c < 3; ++c) {
        EXPECT_EQ(separate.taps->outputs[c].first_x, int(c));
        EXPECT_EQ(separate.taps->outputs[c].weights, std::vector<float>{1.0f});
    }
    expect_bins(made("random3", "pentile"), 3, 1);
    EXPECT_EQ(made("random3", "pentile").taps->outputs.size(), 3u);
}

TEST(Reconstruction, what_makes_no_sense_is_refused) {
    for (const char* method : {"ssaa", "ssaa:0", "ssaa:17", "ssaa:x", "ssaa:", "ssaa:2:2", "pane:", "triads",
                               "filter", "platt:9", "random3:own", "centre:1", "triad:3"})
        EXPECT_THROW(made(method), Error) << method;
    for (const char* method : {"triad", "platt", "platt:3", "displaced", "random3", "random3:shared"})
        EXPECT_THROW(made(method), Error) << method << " without a panel";
    for (const char* method : {"centre", "ssaa:2", "pane", "pane-encoded:3"})
        EXPECT_THROW(made(method, "rgb"), Error) << method << " with a panel";
    ReconstructionChoice choice;
    choice.method = "pane:2", choice.bins = uvec2(3, 3);
    EXPECT_THROW(reconstruction_of(choice), Error);
    choice.bins = uvec2(2, 2);
    EXPECT_NO_THROW(reconstruction_of(choice));
    choice.filter = PixelFilter{};
    EXPECT_THROW(reconstruction_of(choice), Error);
}

TEST(Reconstruction, samples_are_rounded_up_to_whole_bins) {
    EXPECT_EQ(whole_bins(1, 9), 9u);
    EXPECT_EQ(whole_bins(9, 9), 9u);
    EXPECT_EQ(whole_bins(64, 9), 72u);
    EXPECT_EQ(whole_bins(64, 1), 64u);
}
