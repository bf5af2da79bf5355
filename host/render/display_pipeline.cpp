/// resolve_display: bins -> exposure, tone map -> taps -> refinement -> drives, on the device.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "base/error.h"
#include "kernels/types.h"
#include "render/resolve.h"
#include "render/tap_plan.h"

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
            return TONE_PER_BIN;
        case ToneOrder::never:
            return TONE_NEVER;
        case ToneOrder::per_bin_encoded:
            return TONE_BIN_ENCODED;
    }
    throw std::logic_error("no such order");
}

std::size_t round_up(std::size_t n, std::size_t step) { return (n + step - 1) / step * step; }

/// Where the bins come from.
struct BinSource {
    unsigned width, height, columns, rows, bins_x, bins_y;
    bool encoded;
    float unit;             ///< of a film's sums
    const char* kernel;     ///< of subpixel/bins.cl
    bool rows_of_pixels;    ///< its buffers hold rows of pixels, else of bins
    std::size_t row_bytes;  ///< of these
    /// Uploads rows [first, first + count).
    std::function<Arguments(Device&, std::size_t first, std::size_t count)> upload;
};

/// Rows of the picture, half-open.
struct Rows {
    std::size_t begin = 0, end = 0;
    std::size_t count() const { return end - begin; }
};

class DisplayPipeline {
  public:
    DisplayPipeline(Device& device, const BinSource& source, const DisplaySettings& settings)
        : device_(device),
          source_(source),
          settings_(settings),
          plan_(settings.taps ? *settings.taps : box_taps(source.bins_x, source.bins_y),
                settings.alpha && !settings.background),
          lanes_(device.info().type == "cpu" ? 16 : 1) {
        if (plan_.bins_x() != source.bins_x || plan_.bins_y() != source.bins_y)
            throw Error(Exit::usage, "The taps are for " + std::to_string(plan_.bins_x()) + "x" +
                                         std::to_string(plan_.bins_y()) +
                                         " bins per pixel, the picture has " + std::to_string(source.bins_x) +
                                         "x" + std::to_string(source.bins_y) + ".");
        if (const auto& r = settings.refine;
            r && settings.order == ToneOrder::per_bin &&
            std::any_of(r->weights.begin(), r->weights.end(), [](float w) { return w != 0; })) {
            if (r->cell_x != plan_.cell_x())
                throw Error(Exit::usage, "The taps and the refinement are of different panels.");
            refine_steps_ = settings.refine_steps;
        }
        const std::size_t allowed = device.info().max_allocation;
        if (allowed > 0) most_ = allowed;
        cells_ = (source.width + plan_.cell_x() - 1) / plan_.cell_x();
        const std::size_t runs = round_up(cells_, lanes_);
        bins_.stride = round_up(plan_.left() + runs + plan_.right(), lanes_);
        pad_ = refine_steps_ > 0 ? settings.refine->radius : 0;
        pad_cells_ = (pad_ + plan_.cell_x() - 1) / plan_.cell_x();
        drives_.stride = runs + 2 * pad_cells_;
    }

    std::vector<float> run() {
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

  private:
    Device& device_;
    const BinSource& source_;
    const DisplaySettings& settings_;
    const TapPlan plan_;
    const std::size_t lanes_;
    std::size_t most_ = std::size_t(2) << 30;
    unsigned refine_steps_ = 0;
    std::size_t cells_ = 0, pad_ = 0, pad_cells_ = 0;
    PlaneShape bins_, drives_;
    Buffer slab_, planes_, sums_;  ///< of the bins; kept while they are large enough

    unsigned runs() const { return unsigned(round_up(cells_, lanes_) / lanes_); }

    Options options(unsigned taps) const {
        return {{"DISPLAY_LANES", std::to_string(lanes_)}, {"DISPLAY_TAPS", std::to_string(taps)}};
    }

    /// Of a slab that has `margins` rows more: as many as fit into `bytes`, or more where most of these would
    /// be margins, if the device allows.
    std::size_t rows_that_fit(std::size_t bytes, std::size_t row_bytes, std::size_t margins) const {
        const std::size_t fit = bytes / row_bytes, most = most_ / row_bytes;
        const std::size_t rows = fit > 3 * margins ? fit - margins : 2 * margins;
        return std::clamp<std::size_t>(rows, 1, most > margins ? most - margins : 1);
    }

    void reserve(Buffer& buffer, std::size_t bytes) {
        if (buffer.bytes() >= bytes) return;
        buffer = {};
        buffer = device_.allocate(bytes);
    }

    /// Makes drives of rows `made` and writes the pixels of rows `wanted`.
    void drive_rows(const Rows& wanted, const Rows& made, float* display) {
        drives_.plane = (made.count() + 2 * pad_) * drives_.stride;
        const std::size_t bytes = plan_.channels() * plan_.cell_x() * drives_.plane * sizeof(float);
        const Buffer asked = device_.allocate(bytes);
        const std::size_t row_bytes =
            std::max({source_.row_bytes * (source_.rows_of_pixels ? 1 : source_.bins_y),
                      plan_.channels() * plan_.columns() * bins_.stride * source_.bins_y * sizeof(float),
                      plan_.separable()
                          ? plan_.channels() * plan_.cell_x() * plan_.columns() * bins_.stride * sizeof(float)
                          : 0});
        const std::size_t rows = rows_that_fit(bins_bytes, row_bytes, plan_.up() + plan_.down() + 2);
        for (std::size_t begin = made.begin; begin < made.end; begin += rows)
            tap_rows({begin, std::min(begin + rows, made.end)}, made, asked);
        const Buffer shown = refine_steps_ > 0 ? refine(asked, made, bytes) : asked;
        gather(shown, wanted, made, display);
    }

    /// The first float of a row of drives.
    std::uint32_t first_of(std::size_t row, const Rows& made) const {
        return std::uint32_t((pad_ + row - made.begin) * drives_.stride + pad_cells_);
    }

    dev::DisplaySlab slab_of(const Rows& rows, std::size_t source_row) const {
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

    void write_slab(const dev::DisplaySlab& slab) {
        reserve(slab_, sizeof slab);
        device_.write(slab_, &slab, sizeof slab);
    }

    /// Bins of some rows, tone-mapped, and their sums.
    void tap_rows(const Rows& rows, const Rows& made, const Buffer& drives) {
        const std::size_t bin_rows = (rows.count() + plan_.up() + plan_.down()) * source_.bins_y;
        bins_.plane = bin_rows * bins_.stride;
        reserve(planes_, plan_.channels() * plan_.columns() * bins_.plane * sizeof(float));

        // Taps reach over an edge as far as their mirror image reaches in. One more row: the last pixels may
        // lack bins.
        const auto height = std::ptrdiff_t(source_.height);
        const std::ptrdiff_t above = std::ptrdiff_t(rows.begin) - plan_.up() - 1,
                             below = std::ptrdiff_t(rows.end) + plan_.down() + 1;
        std::ptrdiff_t first = std::max<std::ptrdiff_t>(above, 0), end = std::min(below, height);
        if (above < 0) end = std::max(end, std::min(-above, height));
        if (below > height) first = std::min(first, std::max<std::ptrdiff_t>(0, 2 * height - below));
        const std::size_t per_pixel = source_.rows_of_pixels ? 1 : source_.bins_y;
        const std::size_t whole = source_.rows_of_pixels ? source_.height : source_.rows;
        const std::size_t from = std::size_t(first) * per_pixel,
                          count = std::min(whole, std::size_t(end) * per_pixel) - from;
        write_slab(slab_of(rows, from));
        const std::size_t items = bins_.stride / lanes_ * plan_.columns() * bin_rows;
        device_.run(device_.build("subpixel/bins.cl", {{"DISPLAY_LANES", std::to_string(lanes_)}})
                        .kernel(source_.kernel),
                    Arguments()
                        .add(slab_)
                        .add(source_.upload(device_, from, count))
                        .add(planes_)
                        .add(std::uint32_t(items)),
                    items);

        const std::size_t own_row = plan_.up() * source_.bins_y * bins_.stride;
        const auto sum = [&](const PlaneSums& s, const Buffer& in, const Buffer& out, std::size_t runs,
                             std::size_t in_first, std::size_t in_step, std::size_t out_first,
                             const PlaneShape& shape) {
            device_.run(device_.build("subpixel/drives.cl", options(s.taps)).kernel("sum_taps"),
                        Arguments()
                            .add(in)
                            .add(out)
                            .add(device_.upload(s.offsets))
                            .add(device_.upload(s.weights))
                            .add(std::uint32_t(runs))
                            .add(std::uint32_t(rows.count()))
                            .add(std::uint32_t(s.planes))
                            .add(std::uint32_t(s.phases))
                            .add(std::uint32_t(rows.begin % s.phases))
                            .add(std::uint32_t(in_first))
                            .add(std::uint32_t(in_step))
                            .add(std::uint32_t(out_first))
                            .add(std::uint32_t(shape.stride))
                            .add(std::uint32_t(shape.plane)),
                        runs * rows.count() * s.planes);
        };
        if (plan_.separable()) {
            const PlaneShape between{bins_.stride, bins_.stride * rows.count()};
            const PlaneSums down_sums = plan_.down_sums(bins_);
            reserve(sums_, down_sums.planes * between.plane * sizeof(float));
            sum(down_sums, planes_, sums_, bins_.stride / lanes_, own_row, source_.bins_y * bins_.stride, 0,
                between);
            sum(plan_.across_sums(between), sums_, drives, runs(), plan_.left(), between.stride,
                first_of(rows.begin, made), drives_);
        } else {
            sum(plan_.sums(bins_), planes_, drives, runs(), own_row + plan_.left(),
                source_.bins_y * bins_.stride, first_of(rows.begin, made), drives_);
        }
    }

    /// FISTA on rows `made`; those within its reach of a border that is not the picture's are not final.
    Buffer refine(const Buffer& asked, const Rows& made, std::size_t bytes) {
        const Buffer shown = device_.allocate(bytes);
        Buffer error = device_.allocate(bytes), next = device_.allocate(bytes);
        device_.fill_zero(error);
        device_.fill_zero(next);
        const PlaneSums sums = refine_sums(*settings_.refine, drives_);
        const Program program = device_.build("subpixel/drives.cl", options(sums.taps));
        const Buffer offsets = device_.upload(sums.offsets), weights = device_.upload(sums.weights);
        const std::size_t items = std::size_t(runs()) * made.count() * sums.planes;
        const auto shape = [&](Arguments arguments, bool phases) {
            arguments.add(runs()).add(std::uint32_t(made.count())).add(std::uint32_t(sums.planes));
            if (phases)
                arguments.add(std::uint32_t(sums.phases)).add(std::uint32_t(made.begin % sums.phases));
            return arguments.add(first_of(made.begin, made))
                .add(std::uint32_t(drives_.stride))
                .add(std::uint32_t(drives_.plane))
                .add(std::uint32_t(source_.width))
                .add(std::uint32_t(plan_.cell_x()));
        };
        device_.run(program.kernel("refine_begin"),
                    shape(Arguments().add(asked).add(shown).add(error), false), items);
        double t = 1.0;
        for (unsigned step = 0; step < refine_steps_; ++step) {
            const double next_t = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
            device_.run(
                program.kernel("refine_step"),
                shape(Arguments().add(asked).add(shown).add(error).add(next).add(offsets).add(weights).add(
                          float((t - 1.0) / next_t)),
                      true),
                items);
            std::swap(error, next);
            t = next_t;
        }
        return shown;
    }

    void gather(const Buffer& drives, const Rows& wanted, const Rows& made, float* display) {
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
};

}  // namespace

std::vector<float> resolve_display(Device& device, const Film& film, const DisplaySettings& settings) {
    if (film.pixels() == 0) return {};
    const BinSource source{
        .width = film.width,
        .height = film.height,
        .columns = film.width * film.bins_x,
        .rows = film.height * film.bins_y,
        .bins_x = film.bins_x,
        .bins_y = film.bins_y,
        .encoded = false,
        .unit = std::ldexp(1.0f, -film.quanta_log2),
        .kernel = "map_film",
        .rows_of_pixels = true,
        .row_bytes = film.width * film.bins() * 4 * sizeof(std::int64_t),
        .upload = [&film](Device& to, std::size_t first, std::size_t count) {
            const std::size_t bins = film.width * film.bins() * 4;
            return Arguments()
                .add(to.upload(std::span(film.sums).subspan(first * bins, count * bins)))
                .add(to.upload(std::span(film.samples).subspan(first * film.width, count * film.width)));
        }};
    return DisplayPipeline(device, source, settings).run();
}

std::vector<float> resolve_display(Device& device, const BinImage& image, const DisplaySettings& settings) {
    if (image.rgba.empty()) return {};
    const BinSource source{
        .width = image.width(),
        .height = image.height(),
        .columns = image.columns,
        .rows = image.rows,
        .bins_x = image.bins_x,
        .bins_y = image.bins_y,
        .encoded = image.encoded,
        .unit = 1.0f,
        .kernel = "map_image",
        .rows_of_pixels = false,
        .row_bytes = image.columns * 4 * sizeof(float),
        .upload = [&image](Device& to, std::size_t first, std::size_t count) {
            const std::size_t row = std::size_t(image.columns) * 4;
            return Arguments().add(to.upload(std::span(image.rgba).subspan(first * row, count * row)));
        }};
    return DisplayPipeline(device, source, settings).run();
}

}  // namespace triad
