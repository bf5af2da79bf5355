#pragma once
/// Films of a row of pictures.txt.
#include <gtest/gtest.h>

#include "../device/device_fixture.h"
#include "kept_options.h"
#include "kept_picture.h"
#include "kernels/types.h"
#include "render/renderer.h"
#include "session/prepare.h"

namespace triad {

/// Gives films of one case and of consecutive seeds to `receive`. Returns whether pixels of a film share
/// noise: where photons are gathered, one of them shines on many.
template <class Receive>
bool render_films(const KeptCase& c, std::uint32_t first_seed, unsigned films, unsigned spp,
                  const Receive& receive) {
    const RenderRequest options = scene_options(c.name, c.options);
    const Scene scene = load_scene(options);
    RenderSettings settings = settings_of(options, scene);
    if (!options.size) settings.width = 64, settings.height = 36;
    settings.seed = first_seed;
    Renderer renderer(test_device(), scene, settings);
    for (unsigned i = 0; i < films; ++i) {
        if (i > 0) renderer.restart(first_seed + i);
        renderer.render({0, spp}, [](const Progress&) { return true; });
        const Film film = renderer.film();
        EXPECT_EQ(film.counters[COUNTER_NOT_FINITE], 0u);
        receive(film);
    }
    return renderer.packed().integrator.starts_with("photon");
}

}  // namespace triad
