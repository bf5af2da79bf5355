#pragma once
/// What decides a picture, beside the scene.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "panel/taps.h"
#include "scene/scene.h"
#include "scene/view.h"

namespace triad {

/// Where in its bin a camera ray starts.
enum class RayStart {
    jitter,  ///< anywhere, with equal density
    centre,  ///< rays are those of a picture whose pixels are the bins, bit for bit
    filter   ///< by a pixel filter: render/ray_filter.h
};

/// How light is split into wavelengths: docs/spectral.md.
enum class Spectral {
    automatic,  ///< photons where something casts and its light is small or a pilot finds them worth it, else
                ///< paths other
    off,        ///< RGB: bodies refract by their index at the d line
    full,       ///< four wavelengths per path from the camera on; reflectances and lights upsampled from RGB
    classic     ///< one wavelength per path from the camera on, as it was first published
};

/// What brings the light that mirrors and glass throw onto other surfaces.
enum class Integrator {
    automatic,  ///< photons where something casts and its light is small or a pilot finds them worth it, else
                ///< paths
    path,       ///< paths alone: unidirectional path tracing
    photons,    ///< photons from every light: splatted where the camera sees them, gathered elsewhere
    light,      ///< splatted alone; what is met later is left to paths (light tracing)
    photon_map  ///< the classic method: a map of photons from everywhere, made once
};

struct RenderSettings {
    unsigned width = 1280, height = 720;
    std::array<unsigned, 4> crop{};   ///< x, y, width, height; width 0: the whole picture
    unsigned bins_x = 1, bins_y = 1;  ///< bins per pixel
    RayStart ray_start = RayStart::jitter;
    /// For RayStart::filter. With as many bins as channels (3x1), a path starts by the filter of its bin's
    /// channel; with one bin all channels share it.
    TapTable ray_filter;
    std::uint32_t seed = 0;
    unsigned max_depth = 0;  ///< edges of a path; 0: no limit, Russian roulette ends it
    /// Roulette spares a path that carries more than this throughput and kills the others in proportion. No
    /// value biases; the default has the least error for its rays over many scenes
    /// (docs/measurements/2026-11-23-roulette.md).
    double roulette = 0.4;
    /// Random numbers hashed for every sample alone, instead of Sobol's sequence: more error, but known laws.
    bool independent = false;
    /// Colours of textures are means over what a sample stands for, which shrinks with every sample
    /// (docs/shading.md); false: the image's own texels, to compare.
    bool texture_levels = true;
    Spectral spectral = Spectral::automatic;
    Integrator integrator = Integrator::path;
    /// With every sample of the picture (0: one for each pixel, or what render/photon_count.h finds best
    /// where the integrator is automatic); of the classic map: all (0: a million).
    std::uint64_t photons = 0;
    bool aim_photons = true;   ///< at what mirrors and refracts; false: to compare
    double photon_radius = 0;  ///< scene units, of the first sample or of the classic map; 0: chosen
    bool final_gather = true;  ///< classic map: bounce once before it is looked up
    bool transparent =
        false;  ///< the background is not seen by the camera: alpha 0 there (RGB is associated)
    View view;
    double environment_rotation = 0.0;  ///< radians, from +x towards +z
    double environment_strength = 1.0;
    /// Meshes that are placed more than once are flattened (faster) while the scene stays below this many
    /// triangles, and instanced (smaller) beyond.
    std::size_t flatten_below = 2'000'000;
};

/// What these are called on the command line, in films and in JSON.
const char* name_of(RayStart start);
const char* name_of(Spectral spectral);
const char* name_of(Integrator integrator);

/// Whether rays that start here, and the light of the scene so strengthened, stay within scene/limits.h.
/// Throws Error(usage) that names what does not and the option that mends it.
void check_limits(const RenderSettings& settings, const Scene& scene);

/// JSON of every member: equal settings, equal text. What partial renders are compared by.
std::string text_of(const RenderSettings& settings);

}  // namespace triad
