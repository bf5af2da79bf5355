#pragma once
/// What the subpixel bench reconstructs: rendered scenes, and pictures of many samples per pixel that stand
/// for scenes.
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "base/rgb_image.h"
#include "display/reconstruction.h"
#include "render/renderer.h"

namespace triad {

/// A method by its name in the bench.
struct SubpixelMethod {
    std::string name;
    Reconstruction how;
    bool adaptive = false;
};

/// Drives of one run, as a display with 8 bits shows them.
struct SubpixelShot {
    RgbImage drives;  ///< display-linear
    double rays_per_pixel = 0;
    double seconds = 0;  ///< rays and reconstruction; rays that several methods share count for each
};

/// RGBA of resolve_display as a display with 8 bits has it.
RgbImage shown_in_8_bits(unsigned width, unsigned height, const std::vector<float>& rgba);

class SubpixelSource {
  public:
    virtual ~SubpixelSource() = default;
    virtual const RgbImage& reference() const = 0;  ///< display-linear, in [0, 1]
    virtual unsigned samples() const = 0;           ///< of the reference, per pixel along each axis
    virtual bool adapts() const = 0;                ///< whether adaptive sampling makes a difference
    /// Rays that were traced before are not wanted any more.
    virtual void forget() = 0;
    /// At least `rays` per pixel, as many in every bin. Methods whose rays are alike share them.
    virtual SubpixelShot shoot(const SubpixelMethod& method, unsigned rays, std::uint32_t seed) = 0;
};

/// A scene, rendered. The reference is rendered first, at `samples` times the size.
struct RenderedView {
    std::shared_ptr<const Scene> scene;
    RenderSettings settings;  ///< of the picture
    float exposure_ev = 0;
    ToneMap tone_map = ToneMap::khronos;
    unsigned samples = 6, reference_spp = 256;
};
std::unique_ptr<SubpixelSource> rendered_source(Device& device, const RenderedView& view);

/// A picture of so many samples per pixel along each axis: a ray sees the sample that it meets, without noise
/// of its own. The reference is the picture, with half as many samples where these are 12 or more and even.
/// Throws Error(scene) that names the picture when it has no pixels, or no whole number of them.
std::unique_ptr<SubpixelSource> sampled_source(Device& device, const std::string& name, RgbImage picture,
                                               unsigned samples);

}  // namespace triad
