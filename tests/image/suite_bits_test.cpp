// What a scene does not need is left out of the kernels, and that changes no bit of its picture.
#include <gtest/gtest.h>

#include "../device/device_fixture.h"
#include "cli/experiment.h"
#include "cli/suite.h"
#include "render/renderer.h"
#include "session/prepare.h"

namespace triad {
namespace {

class Suite : public testing::TestWithParam<NamedOptions> {};

TEST_P(Suite, specialised_and_general_program_give_the_same_bits) {
    const RenderRequest options = render_options({}, GetParam(), {});
    const Scene scene = load_scene(options);
    RenderSettings settings = settings_of(options, scene);
    settings.width = 32, settings.height = 18;
    const auto film = [&](const std::optional<Features>& features) {
        Renderer renderer(test_device(), scene, settings, features);
        if (!features) {
            EXPECT_FALSE(left_out(renderer.features()).empty());
        }
        renderer.render({0, 4}, [](const Progress&) { return true; });
        return renderer.film();
    };
    const Film specialised = film({}), general = film(Features{});
    EXPECT_EQ(specialised.sums, general.sums);
    EXPECT_EQ(specialised.half_sums, general.half_sums);
    EXPECT_EQ(specialised.counters, general.counters);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Suite, testing::ValuesIn(suite_scenes(TRIAD_SCENES)), [](const auto& info) {
    std::string name = info.param.name;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
});

}  // namespace
}  // namespace triad
