#include "display/denoise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "display/open_image_denoise.h"
#include "kernels/types.h"

namespace triad {
namespace {

/// What a pixel may become beside the mean of its samples: strengths of the filter, and cells of the patches
/// by which it weighs its neighbours. Measured on the suite (docs/measurements/2026-11-25-denoise.md).
struct Candidate {
    int patch;
    float strength;
};
constexpr Candidate candidates[] = {{3, 0.45f}, {1, 0.6f}, {1, 1.2f}};
constexpr std::uint32_t candidate_count = std::size(candidates);

/// Of the distances of some rows.
constexpr std::size_t most_distance_bytes = std::size_t(64) << 20;

/// That half of the pixels which show a surface lie beyond.
float middle_depth(const Film& film) {
    std::vector<float> depths;
    for (std::size_t i = DENOISE_GUIDES - 1; i < film.guides.size(); i += DENOISE_GUIDES)
        if (film.guides[i] > 0.0f && std::isfinite(film.guides[i])) depths.push_back(film.guides[i]);
    if (depths.empty()) return 1.0f;
    const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

class OwnDenoiser {
  public:
    OwnDenoiser(Device& device, const Film& film, std::optional<unsigned> lanes)
        : device_(device), film_(film), lanes_(lanes.value_or(display_shape(device.info()).lanes)) {
        shape_.width = film.width, shape_.height = film.height;
        shape_.stride = (film.width + 15) / 16 * 16 + 2 * DENOISE_MARGIN;
        shape_.plane = shape_.stride * (film.height + 2 * DENOISE_MARGIN);
        shape_.middle_depth = middle_depth(film);
        on_device_ = device.upload(std::span<const dev::DenoiseShape>(&shape_, 1));
    }

    std::vector<float> run() {
        const HalfMeans halves = half_means(film_).value();
        planes_ = device_.allocate_array<float>(std::size_t(DENOISE_PLANES) * shape_.plane);
        fill("fill_planes", {device_.upload(halves.first), device_.upload(halves.second)}, planes_);
        if (!film_.guides.empty()) {
            guides_ = device_.allocate_array<float>(std::size_t(DENOISE_GUIDES) * shape_.plane);
            fill("fill_guides", {device_.upload(film_.guides)}, guides_);
        }
        filtered_ = device_.allocate_array<float>(std::size_t(candidate_count) * 6 * shape_.plane);
        regress();
        return mixed();
    }

  private:
    Device& device_;
    const Film& film_;
    const unsigned lanes_;
    dev::DenoiseShape shape_{};
    Buffer on_device_, planes_, guides_, filtered_;

    Program program(const char* path) const {
        return device_.build(path, {{"DENOISE_LANES", std::to_string(lanes_)},
                                    {"DENOISE_USED", film_.guides.empty() ? "0" : "DENOISE_GUIDES"}});
    }
    std::size_t pixels() const { return std::size_t(shape_.width) * shape_.height; }

    void fill(const char* kernel, const std::vector<Buffer>& from, const Buffer& to) {
        Arguments arguments = Arguments().add(on_device_);
        for (const Buffer& buffer : from) arguments.add(buffer);
        device_.run(program("denoise/choose.cl").kernel(kernel), arguments.add(to), shape_.plane);
    }

    /// Every candidate for both halves, some rows at a time: distances take much memory.
    void regress() {
        constexpr std::size_t offsets = DENOISE_SIDE * DENOISE_SIDE;
        const std::size_t row_bytes = offsets * shape_.stride * sizeof(float);
        const std::size_t fit = std::max<std::size_t>(most_distance_bytes / row_bytes, 2 * DENOISE_PATCH + 8);
        const auto rows = std::uint32_t(std::min<std::size_t>(fit - 2 * DENOISE_PATCH, shape_.height));
        const Buffer distances = device_.allocate(row_bytes * (rows + 2 * DENOISE_PATCH));
        const Program program = this->program("denoise/regress.cl");
        const Kernel measure = program.kernel("measure_distances"), regress = program.kernel("regress");
        for (std::uint32_t first = 0; first < shape_.height; first += rows) {
            const std::uint32_t count = std::min(rows, shape_.height - first);
            for (std::uint32_t half = 0; half < 2; ++half) {
                const std::uint32_t own = half == 0 ? DENOISE_FIRST : DENOISE_SECOND,
                                    other = half == 0 ? DENOISE_SECOND : DENOISE_FIRST;
                device_.run(
                    measure,
                    Arguments().add(on_device_).add(planes_).add(other).add(first).add(count).add(distances),
                    offsets * (count + 2 * DENOISE_PATCH) * shape_.stride / lanes_);
                for (std::uint32_t c = 0; c < candidate_count; ++c) {
                    const Candidate& candidate = candidates[c];
                    const int side = 2 * candidate.patch + 1;
                    const float scale = 1.0f / (float(side * side) * candidate.strength * candidate.strength);
                    device_.run(regress,
                                Arguments()
                                    .add(on_device_)
                                    .add(planes_)
                                    .add(film_.guides.empty() ? planes_ : guides_)  // not read
                                    .add(distances)
                                    .add(own)
                                    .add(first)
                                    .add(count)
                                    .add(candidate.patch)
                                    .add(scale)
                                    .add(filtered_)
                                    .add(6 * c + 3 * half),
                                std::size_t(count) * ((shape_.width + lanes_ - 1) / lanes_));
                }
            }
            device_.finish();
        }
    }

    /// Each pixel by the candidate that has the least error around it.
    std::vector<float> mixed() {
        const Program program = this->program("denoise/choose.cl");
        const std::uint32_t count = candidate_count + 1;  // with the samples' own mean
        const Buffer errors = device_.allocate_array<float>(std::size_t(count) * shape_.plane),
                     choices = device_.allocate_array<std::uint32_t>(pixels()),
                     means = device_.upload(resolve_linear(film_));
        const Kernel measure = program.kernel("measure_errors");
        for (std::uint32_t c = 0; c < count; ++c)
            device_.run(measure, Arguments().add(on_device_).add(planes_).add(filtered_).add(c).add(errors),
                        pixels());
        device_.run(program.kernel("choose"), Arguments().add(on_device_).add(errors).add(count).add(choices),
                    pixels());
        device_.run(program.kernel("mix_choices"),
                    Arguments().add(on_device_).add(choices).add(filtered_).add(count).add(means), pixels());
        return device_.download<float>(means);
    }
};

constexpr struct {
    const char* name;
    Denoiser denoiser;
} denoisers[] = {{"off", Denoiser::off}, {"own", Denoiser::own}, {"oidn", Denoiser::oidn}};

}  // namespace

const char* name_of(Denoiser denoiser) {
    for (const auto& each : denoisers)
        if (each.denoiser == denoiser) return each.name;
    return "off";
}

Denoiser denoiser_named(const std::string& name) {
    for (const auto& each : denoisers)
        if (each.name == name) return each.denoiser;
    throw Error(Exit::usage, "--denoise " + name + ": there are off, own and oidn.");
}

void refuse_to_denoise_bins() {
    throw Error(
        Exit::usage,
        "--denoise works on whole pixels, and there are several bins in each: leave out --denoise, or "
        "--bins, --filter, --reconstruct and --panel.");
}

void require_denoisable(const Film& film) {
    if (film.bins() > 1) refuse_to_denoise_bins();
    if (film.sample_numbers().least < 2)
        throw Error(Exit::usage,
                    "--denoise tells noise by two halves of the samples: every pixel needs two "
                    "samples at least (--spp).");
}

BinImage denoised(Device& device, const Film& film, Denoiser denoiser, std::optional<unsigned> lanes) {
    require_denoisable(film);
    BinImage image{.columns = film.width, .rows = film.height, .rgba = {}};
    image.rgba = denoiser == Denoiser::own    ? OwnDenoiser(device, film, lanes).run()
                 : denoiser == Denoiser::oidn ? open_image_denoised(film)
                                              : resolve_linear(film);
    return image;
}

}  // namespace triad
