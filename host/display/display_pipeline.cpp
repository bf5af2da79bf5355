#include "display/display_pipeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.h"

namespace triad {
namespace {

/// Of one piece of device memory, where the device does not ask for less. Bins go through in slabs that stay
/// in a CPU's cache; a refinement reaches far, so that its slabs are larger.
constexpr std::size_t bins_bytes = std::size_t(8) << 20, drives_bytes = std::size_t(256) << 20;

std::uint32_t code_of(ToneMap map) {
    switch (map) {
        case ToneMap::none:
            return TONE_MAP_NONE;
        case ToneMap::khronos:
            return TONE_MAP_KHRONOS;
        case ToneMap::aces:
            return TONE_MAP_ACES;
        case ToneMap::agx:
            return TONE_MAP_AGX;
    }
    throw std::logic_error("no such tone map");
}

std::uint32_t code_of(ToneOrder order) {
    switch (order) {
        case ToneOrder::per_pixel:
            return TONE_PER_PIXEL;
        case ToneOrder::per_bin:
        case ToneOrder::noise_aware:
            return TONE_PER_BIN;
        case ToneOrder::never:
            return TONE_NEVER;
        case ToneOrder::per_bin_encoded:
            return TONE_BIN_ENCODED;
    }
    throw std::logic_error("no such order");
}

std::size_t round_up(std::size_t n, std::size_t step) { return (n + step - 1) / step * step; }

}  // namespace

DisplayShape display_shape(const DeviceInfo& device) {
    return device.type == "cpu" ? DisplayShape{16, 1} : DisplayShape{1, 4};
}

DisplayPipeline::DisplayPipeline(Device& device, const BinSource& source, const DisplaySettings& settings)
    : device_(device),
      source_(source),
      settings_(settings),
      plan_(settings.taps ? *settings.taps : box_taps(source.bins_x, source.bins_y),
            // whoever maps tones puts them on the background, and needs alpha for that
            settings.background ? settings.order == ToneOrder::per_pixel : settings.alpha),
      shape_(settings.shape.value_or(display_shape(device.info()))) {
    if (plan_.bins_x() != source.bins_x || plan_.bins_y() != source.bins_y)
        throw Error(Exit::usage, "The taps are for " + std::to_string(plan_.bins_x()) + "x" +
                                     std::to_string(plan_.bins_y()) + " bins per pixel, the picture has " +
                                     std::to_string(source.bins_x) + "x" + std::to_string(source.bins_y) +
                                     ".");
    if (const auto& r = settings.refine;
        r && (settings.order == ToneOrder::per_bin || settings.order == ToneOrder::noise_aware) &&
        std::any_of(r->weights.begin(), r->weights.end(), [](float w) { return w != 0; })) {
        if (r->cell_x != plan_.cell_x())
            throw Error(Exit::usage, "The taps and the refinement are of different panels.");
        refine_steps_ = settings.refine_steps;
    }
    const std::size_t allowed = device.info().max_allocation;
    if (allowed > 0) most_ = allowed;
    cells_ = (source.width + plan_.cell_x() - 1) / plan_.cell_x();
    const std::size_t runs = round_up(cells_, shape_.lanes);
    bins_.stride = round_up(plan_.left() + runs + plan_.right(), shape_.lanes);
    pad_ = refine_steps_ > 0 ? settings.refine->radius : 0;
    pad_cells_ = (pad_ + plan_.cell_x() - 1) / plan_.cell_x();
    drives_.stride = runs + 2 * pad_cells_;
}

std::vector<float> DisplayPipeline::run() {
    std::vector<float> display(std::size_t(source_.width) * source_.height * 4);
    // What the last step changes depends on what lies a radius further at each step before.
    const std::size_t reach = refine_steps_ * pad_;
    const std::size_t row_bytes =
        std::max(plan_.channels() * plan_.cell_x() * drives_.stride, source_.width * std::size_t(4)) *
        sizeof(float);
    const std::size_t rows = rows_that_fit(drives_bytes, row_bytes, 2 * (reach + pad_));
    for (std::size_t begin = 0; begin < source_.height; begin += rows) {
        const Rows wanted{begin, std::min<std::size_t>(begin + rows, source_.height)};
        const Rows made{begin - std::min(begin, reach),
                        std::min<std::size_t>(wanted.end + reach, source_.height)};
        drive_rows(wanted, made, &display[begin * source_.width * 4]);
    }
    return display;
}

unsigned DisplayPipeline::runs() const { return unsigned(round_up(cells_, shape_.lanes) / shape_.lanes); }

Options DisplayPipeline::options(unsigned taps) const {
    return {{"DISPLAY_LANES", std::to_string(shape_.lanes)},
            {"DISPLAY_ROWS", std::to_string(shape_.rows)},
            {"DISPLAY_TAPS", std::to_string(taps)}};
}

/// Groups of rows of one phase, of which a work-item does one.
std::uint32_t DisplayPipeline::row_groups(std::size_t rows, const PlaneSums& sums) const {
    return std::uint32_t(round_up(rows, sums.phases * shape_.rows) / shape_.rows);
}

/// Of a slab that has `margins` rows more: as many as fit into `bytes`, or more where most of these would
/// be margins, if the device allows.
std::size_t DisplayPipeline::rows_that_fit(std::size_t bytes, std::size_t row_bytes,
                                           std::size_t margins) const {
    const std::size_t fit = bytes / row_bytes, most = most_ / row_bytes;
    const std::size_t rows = fit > 3 * margins ? fit - margins : 2 * margins;
    return std::clamp<std::size_t>(rows, 1, most > margins ? most - margins : 1);
}

void DisplayPipeline::reserve(Buffer& buffer, std::size_t bytes) {
    if (buffer.bytes() >= bytes) return;
    buffer = {};
    buffer = device_.allocate(bytes);
}

/// Makes drives of rows `made` and writes the pixels of rows `wanted`.
void DisplayPipeline::drive_rows(const Rows& wanted, const Rows& made, float* display) {
    drives_.plane = (made.count() + 2 * pad_) * drives_.stride;
    const std::size_t bytes = plan_.channels() * plan_.cell_x() * drives_.plane * sizeof(float);
    const Buffer asked = device_.allocate(bytes);
    const std::size_t row_bytes =
        std::max({source_.row_bytes * (source_.rows_of_pixels ? 1 : source_.bins_y),
                  plan_.channels() * plan_.columns() * bins_.stride * source_.bins_y * sizeof(float),
                  plan_.separable()
                      ? plan_.channels() * plan_.cell_x() * plan_.columns() * bins_.stride * sizeof(float)
                      : 0});
    const std::size_t rows =
        rows_that_fit(bins_bytes, row_bytes, plan_.up() + plan_.down() + 2 * std::size_t(rows_around()));
    for (std::size_t begin = made.begin; begin < made.end; begin += rows)
        tap_rows({begin, std::min(begin + rows, made.end)}, made, asked);
    const Buffer shown = refine_steps_ > 0 ? refine(asked, made, bytes) : asked;
    gather(shown, wanted, made, display);
}

/// The first float of a row of drives.
std::uint32_t DisplayPipeline::first_of(std::size_t row, const Rows& made) const {
    return std::uint32_t((pad_ + row - made.begin) * drives_.stride + pad_cells_);
}

dev::DisplaySlab DisplayPipeline::slab_of(const Rows& rows, std::size_t source_row) const {
    dev::DisplaySlab s{};
    s.width = source_.width, s.height = source_.height;
    s.columns = source_.columns, s.rows = source_.rows;
    s.bins[0] = source_.bins_x, s.bins[1] = source_.bins_y;
    s.cell_x = plan_.cell_x();
    s.channels = plan_.channels();
    s.left = plan_.left();
    s.stride = std::uint32_t(bins_.stride), s.plane = std::uint32_t(bins_.plane);
    s.first_row = (int(rows.begin) - int(plan_.up())) * int(source_.bins_y);
    s.source_row = std::uint32_t(source_row);
    s.tone_map = code_of(settings_.tone_map);
    s.order = code_of(settings_.order);
    s.encoded = source_.encoded;
    s.unit = source_.unit;
    s.exposure = std::exp2(settings_.exposure_ev);
    if (settings_.background) {
        for (int c = 0; c < 3; ++c) s.background[c] = (*settings_.background)[c];
        s.background[3] = 1.0f;
    }
    return s;
}

void DisplayPipeline::write_slab(const dev::DisplaySlab& slab) {
    reserve(slab_, sizeof slab);
    device_.write(slab_, &slab, sizeof slab);
}

void DisplayPipeline::gather(const Buffer& drives, const Rows& wanted, const Rows& made, float* display) {
    write_slab(slab_of(wanted, 0));
    const std::size_t pixels = wanted.count() * source_.width;
    const Buffer out = device_.allocate(pixels * 4 * sizeof(float));
    device_.run(device_.build("subpixel/drives.cl", options(1)).kernel("gather_drives"),
                Arguments()
                    .add(slab_)
                    .add(drives)
                    .add(out)
                    .add(std::uint32_t(wanted.count()))
                    .add(first_of(wanted.begin, made))
                    .add(std::uint32_t(drives_.stride))
                    .add(std::uint32_t(drives_.plane)),
                pixels);
    device_.read(out, display, pixels * 4 * sizeof(float));
}
}  // namespace triad
