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
constexpr std::uint32_t choice_count = candidate_count + 1;  // with the samples' own mean

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

/// Mean RGBA of one bin of every pixel.
std::vector<float> bin_means(const Film& film, std::size_t bin) {
    std::vector<float> rgba(film.pixels() * 4);
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const double scale = std::ldexp(1.0, -film.quanta_log2) * double(film.bins()) / film.samples[p];
        for (std::size_t c = 0; c < 4; ++c)
            rgba[4 * p + c] = float(double(film.sums[(p * film.bins() + bin) * 4 + c]) * scale);
    }
    return rgba;
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

    /// Chooses a filter for every pixel.
    void choose() {
        const HalfMeans halves = half_means(film_).value();
        const Buffer first = device_.upload(halves.first), second = device_.upload(halves.second);
        const auto bounded_first = device_.allocate_array<float>(halves.first.size()),
                   bounded_second = device_.allocate_array<float>(halves.second.size());
        device_.run(program("denoise/choose.cl").kernel("bound_sparks"),
                    Arguments().add(on_device_).add(first).add(second).add(bounded_first).add(bounded_second),
                    3 * pixels());
        planes_ = planes_of(bounded_first, bounded_second);
        share_ = device_.download<float>(bounded_first);
        const std::vector<float> other = device_.download<float>(bounded_second);
        for (std::size_t i = 0; i < share_.size(); ++i) {
            const float all = halves.first[i] + halves.second[i];
            share_[i] = all > 0 ? (share_[i] + other[i]) / all : 1.0f;
        }
        if (!film_.guides.empty()) {
            guides_ = device_.allocate_array<float>(std::size_t(DENOISE_GUIDES) * shape_.plane);
            fill("fill_guides", {device_.upload(film_.guides)}, guides_);
        }
        filtered_ = device_.allocate_array<float>(std::size_t(candidate_count) * 6 * shape_.plane);
        regress(planes_);
        const Program program = this->program("denoise/choose.cl");
        const Buffer errors = device_.allocate_array<float>(std::size_t(choice_count) * shape_.plane);
        const Kernel measure = program.kernel("measure_errors");
        for (std::uint32_t c = 0; c < choice_count; ++c)
            device_.run(measure, Arguments().add(on_device_).add(planes_).add(filtered_).add(c).add(errors),
                        pixels());
        choices_ = device_.allocate_array<std::uint32_t>(pixels());
        device_.run(program.kernel("choose"),
                    Arguments().add(on_device_).add(errors).add(choice_count).add(choices_), pixels());
    }

    /// These means of the film's pixels, or of one bin of each, by the filters that were chosen: a filter is
    /// a weighted mean, whose weights are those of the pixels for every bin.
    std::vector<float> filtered(const std::vector<float>& rgba) {
        std::vector<float> bounded = rgba, rgb(pixels() * 3);
        for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = bounded[i / 3 * 4 + i % 3] *= share_[i];
        if (film_.bins() > 1) {
            const Buffer colours = device_.upload(rgb);
            regress(planes_of(colours, colours));
        }
        const Buffer means = device_.upload(bounded);
        device_.run(program("denoise/choose.cl").kernel("mix_choices"),
                    Arguments().add(on_device_).add(choices_).add(filtered_).add(choice_count).add(means),
                    pixels());
        return device_.download<float>(means);
    }

  private:
    Device& device_;
    const Film& film_;
    const unsigned lanes_;
    dev::DenoiseShape shape_{};
    Buffer on_device_, planes_, guides_, filtered_, choices_;
    std::vector<float> share_;  ///< of a pixel's light, [pixel][3], that is no spark

    Program program(const char* path) const {
        return device_.build(path, {{"DENOISE_LANES", std::to_string(lanes_)},
                                    {"DENOISE_USED", film_.guides.empty() ? "0" : "DENOISE_GUIDES"}});
    }
    std::size_t pixels() const { return std::size_t(shape_.width) * shape_.height; }

    Buffer planes_of(const Buffer& first, const Buffer& second) {
        const Buffer planes = device_.allocate_array<float>(std::size_t(DENOISE_PLANES) * shape_.plane);
        fill("fill_planes", {first, second}, planes);
        return planes;
    }
    void fill(const char* kernel, const std::vector<Buffer>& from, const Buffer& to) {
        Arguments arguments = Arguments().add(on_device_);
        for (const Buffer& buffer : from) arguments.add(buffer);
        device_.run(program("denoise/choose.cl").kernel(kernel), arguments.add(to), shape_.plane);
    }

    /// Every candidate for both halves of `colours`, weighed by the film's halves, some rows at a time:
    /// distances take much memory.
    void regress(const Buffer& colours) {
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
                                    .add(colours)
                                    .add(film_.guides.empty() ? colours : guides_)  // not read
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

void require_denoisable(Denoiser denoiser, std::uint64_t bins, std::uint64_t samples) {
    if (denoiser == Denoiser::off) return;
    const std::string name = std::string("--denoise ") + name_of(denoiser);
    if (denoiser == Denoiser::oidn && bins > 1)
        throw Error(Exit::usage,
                    name +
                        " works on whole pixels, and there are several bins in each: use --denoise "
                        "own, or leave out --bins, --filter, --reconstruct and --panel.");
    if (samples < 2 * bins)
        throw Error(Exit::usage, name + " tells noise by two halves of the samples: every pixel needs " +
                                     std::to_string(2 * bins) + " at least (--spp)" +
                                     (bins > 1 ? ", two for each of its bins." : "."));
}

BinImage denoised(Device& device, const Film& film, Denoiser denoiser, std::optional<unsigned> lanes) {
    require_denoisable(denoiser, film.bins(), film.sample_numbers().least);
    BinImage image{.columns = film.width * film.bins_x,
                   .rows = film.height * film.bins_y,
                   .bins_x = film.bins_x,
                   .bins_y = film.bins_y,
                   .rgba = {}};
    image.rgba.resize(std::size_t(image.columns) * image.rows * 4);
    std::optional<OwnDenoiser> own;
    if (denoiser == Denoiser::own) own.emplace(device, film, lanes).choose();
    for (std::size_t bin = 0; bin < film.bins(); ++bin) {
        std::vector<float> rgba = bin_means(film, bin);
        if (own) rgba = own->filtered(rgba);
        if (denoiser == Denoiser::oidn) rgba = open_image_denoised(film);
        for (std::size_t p = 0; p < film.pixels(); ++p) {
            const std::size_t x = p % film.width * film.bins_x + bin % film.bins_x,
                              y = p / film.width * film.bins_y + bin / film.bins_x;
            std::copy_n(&rgba[4 * p], 4, &image.rgba[4 * (y * image.columns + x)]);
        }
    }
    return image;
}

}  // namespace triad
