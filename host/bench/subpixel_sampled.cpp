#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "base/colour.h"
#include "base/error.h"
#include "base/text.h"
#include "bench/subpixel_source.h"
#include "pack/ray_filter.h"

namespace triad {
namespace {

/// Where a ray starts in its pixel, and what its R, G and B count.
struct Start {
    dvec2 at;
    vec3 weight{1};
};

class SampledSource : public SubpixelSource {
  public:
    SampledSource(Device& device, RgbImage picture, unsigned samples)
        : device_(device),
          picture_(std::move(picture)),
          samples_(samples),
          reference_samples_(samples >= 12 && samples % 2 == 0 ? samples / 2 : samples),
          reference_(block_means(picture_, samples_ / reference_samples_, samples_ / reference_samples_)) {}

    const RgbImage& reference() const override { return reference_; }
    unsigned samples() const override { return reference_samples_; }
    bool adapts() const override { return false; }
    void forget() override { traced_.clear(); }

    SubpixelShot shoot(const SubpixelMethod& method, unsigned rays, std::uint32_t seed) override {
        const Reconstruction& how = method.how;
        const unsigned w = picture_.width / samples_, h = picture_.height / samples_;
        const auto spp = unsigned(whole_bins(rays, how.bins_x * how.bins_y));
        const Traced& bins = traced(how, w, h, spp / (how.bins_x * how.bins_y), seed);
        DisplaySettings settings;
        settings.tone_map = ToneMap::none, settings.alpha = false;
        apply(how, settings);
        const auto begin = std::chrono::steady_clock::now();
        const auto rgba = resolve_display(device_, bins.image, settings);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        return {shown_in_8_bits(w, h, rgba), double(spp), bins.seconds + seconds.count()};
    }

  private:
    struct Traced {
        BinImage image;
        double seconds = 0;
    };

    const Traced& traced(const Reconstruction& how, unsigned w, unsigned h, unsigned per_bin,
                         std::uint32_t seed) {
        RenderSettings rays;
        apply(how, rays);
        const auto [found, is_new] =
            traced_.try_emplace(text_of(rays) + format(" %u %u", per_bin, seed), Traced());
        if (is_new) {
            const auto begin = std::chrono::steady_clock::now();
            found->second.image = trace(how, w, h, per_bin, seed);
            found->second.seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        }
        return found->second;
    }

    BinImage trace(const Reconstruction& how, unsigned w, unsigned h, unsigned per_bin,
                   std::uint32_t seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> any;
        RenderSettings rays;
        apply(how, rays);
        const std::vector<float> tables = ray_filter_tables(rays);
        const dev::RayFilterShape shape =
            how.ray_start == RayStart::filter ? ray_filter_shape(rays) : dev::RayFilterShape{};
        BinImage image{w * how.bins_x, h * how.bins_y, how.bins_x, how.bins_y, {}, false};
        for (unsigned y = 0; y < image.rows; ++y)
            for (unsigned x = 0; x < image.columns; ++x) {
                vec3 sum{0};
                for (unsigned i = 0; i < per_bin; ++i) {
                    // One of the cells of a grid for each ray, as good sequences give.
                    const double u = any(random), v = (any(random) + i) / per_bin;
                    const unsigned bin = y % how.bins_y * how.bins_x + x % how.bins_x;
                    const dvec2 pixel(x / how.bins_x, y / how.bins_y);
                    Start start;
                    if (how.ray_start == RayStart::filter)
                        start = by_filter(tables, shape, bin, uvec2(pixel), u, v);
                    else
                        start.at = (dvec2(x % how.bins_x, y % how.bins_y) +
                                    (how.ray_start == RayStart::centre ? dvec2(0.5) : dvec2(u, v))) /
                                   dvec2(how.bins_x, how.bins_y);
                    sum += start.weight * see(pixel + start.at);
                }
                const vec3 mean = sum / float(per_bin);
                image.rgba.insert(image.rgba.end(), {mean.x, mean.y, mean.z, 1});
            }
        return image;
    }

    /// kernels/shading/ray_filter.h on the host.
    static Start by_filter(const std::vector<float>& tables, const dev::RayFilterShape& shape, unsigned bin,
                           const uvec2& pixel, double u, double v) {
        const unsigned bins = unsigned(tables.size()) / (shape.table * shape.cell[0] * shape.cell[1]);
        const unsigned cell = pixel.y % shape.cell[1] * shape.cell[0] + pixel.x % shape.cell[0];
        const float* table = tables.data() + std::size_t(cell * bins + bin) * shape.table;
        const auto find = [](const float* bounds, unsigned size, double& at) {
            unsigned i = 0;
            while (i + 1 < size && at >= bounds[i]) ++i;
            const double low = i > 0 ? bounds[i - 1] : 0, width = bounds[i] - low;
            at = width > 0 ? std::min((at - low) / width, 1.0) : 0.5;
            return i;
        };
        const float* rows = table + 2;
        const float* columns = rows + shape.height;
        const unsigned row = find(rows, shape.height, v),
                       column = find(columns + row * shape.width, shape.width, u);
        const float* weight = columns + shape.height * shape.width + (row * shape.width + column) * 3;
        return {{(table[0] + column + u) / shape.taps[0], (table[1] + row + v) / shape.taps[1]},
                {weight[0], weight[1], weight[2]}};
    }

    /// The mean of the two by two samples around a point, in px: on a corner of samples all count alike.
    /// Beyond its border the picture is mirrored.
    vec3 see(const dvec2& at) const {
        const dvec2 sample = at * double(samples_);
        const auto low = glm::ivec2(glm::floor(sample - 1e-6)), high = glm::ivec2(glm::floor(sample + 1e-6));
        vec3 sum{0};
        for (const int y : {low.y, high.y})
            for (const int x : {low.x, high.x}) {
                const float* rgb =
                    picture_.rgb.data() + (std::size_t(mirrored_index(y, picture_.height)) * picture_.width +
                                           mirrored_index(x, picture_.width)) *
                                              3;
                sum += vec3(rgb[0], rgb[1], rgb[2]) / 4.0f;
            }
        return sum;
    }

    Device& device_;
    const RgbImage picture_;
    const unsigned samples_, reference_samples_;
    const RgbImage reference_;
    std::map<std::string, Traced> traced_;
};

}  // namespace

std::unique_ptr<SubpixelSource> sampled_source(Device& device, const std::string& name, RgbImage picture,
                                               unsigned samples) {
    if (picture.rgb.empty() || picture.width % samples > 0 || picture.height % samples > 0)
        throw Error(Exit::scene,
                    name + format(": R, G and B, and a size that %u divides, are needed.", samples));
    return std::make_unique<SampledSource>(device, std::move(picture), samples);
}

}  // namespace triad
