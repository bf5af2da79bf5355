// The stages between bins and drives: tone maps, taps, refinement.
#include <algorithm>
#include <cmath>

#include "display/display_pipeline.h"

namespace triad {

/// Rows that the bins of a row need on each side: the last pixels may lack some, and noise shows in the bins
/// and the pixels around.
std::ptrdiff_t DisplayPipeline::rows_around() const { return 1 + (source_.halves ? NOISE_REACH : 0); }

/// Rows of the source's buffers that some rows of the picture need.
DisplayPipeline::Rows DisplayPipeline::source_rows(const Rows& rows) const {
    // Taps reach over an edge as far as their mirror image reaches in.
    const auto height = std::ptrdiff_t(source_.height);
    const std::ptrdiff_t above = std::ptrdiff_t(rows.begin) - plan_.up() - rows_around(),
                         below = std::ptrdiff_t(rows.end) + plan_.down() + rows_around();
    std::ptrdiff_t first = std::max<std::ptrdiff_t>(above, 0), end = std::min(below, height);
    if (above < 0) end = std::max(end, std::min(-above, height));
    if (below > height) first = std::min(first, std::max<std::ptrdiff_t>(0, 2 * height - below));
    const std::size_t per_pixel = source_.rows_of_pixels ? 1 : source_.bins_y;
    const std::size_t whole = source_.rows_of_pixels ? source_.height : source_.rows;
    return {std::size_t(first) * per_pixel, std::min(whole, std::size_t(end) * per_pixel)};
}

/// Planes of the bins of some rows, tone-mapped.
void DisplayPipeline::map_rows(const Rows& rows) {
    const std::size_t bin_rows = (rows.count() + plan_.up() + plan_.down()) * source_.bins_y;
    bins_.plane = bin_rows * bins_.stride;
    reserve(planes_, plan_.channels() * plan_.columns() * bins_.plane * sizeof(float));
    const Rows from = source_rows(rows);
    write_slab(slab_of(rows, from.begin));
    const Program program =
        device_.build("subpixel/bins.cl", {{"DISPLAY_LANES", std::to_string(shape_.lanes)}});
    const Arguments source = Arguments().add(slab_).add(source_.upload(device_, from.begin, from.count()));
    const std::size_t items = bins_.stride / shape_.lanes * plan_.columns() * bin_rows;
    const Arguments map = Arguments(source).add(planes_).add(std::uint32_t(items));
    if (source_.halves) {
        constexpr std::size_t record = NOISE_RECORD;
        const std::size_t pixels = from.count() * source_.width;
        reserve(means_, pixels * record * sizeof(float));
        const Arguments means = Arguments(source).add(means_).add(std::uint32_t(from.count()));
        device_.run(program.kernel("average_film"), means, pixels);
        device_.run(program.kernel("weigh_noise"),
                    Arguments(means).add(source_.halves(device_, from.begin, from.count())), pixels);
        device_.run(program.kernel("mend_noise"),
                    Arguments().add(slab_).add(means_).add(std::uint32_t(from.count())), pixels);
        device_.run(program.kernel("map_noisy_film"), Arguments(map).add(means_), items);
    } else {
        device_.run(program.kernel(source_.kernel), map, items);
    }
}

/// Weighted sums of the bins of some rows.
void DisplayPipeline::tap_rows(const Rows& rows, const Rows& made, const Buffer& drives) {
    map_rows(rows);
    const std::size_t own_row = plan_.up() * source_.bins_y * bins_.stride;
    const auto sum = [&](const PlaneSums& s, const Buffer& in, const Buffer& out, std::size_t runs,
                         std::size_t in_first, std::size_t in_step, std::size_t out_first,
                         const PlaneShape& shape) {
        const std::uint32_t groups = row_groups(rows.count(), s);
        device_.run(device_.build("subpixel/drives.cl", options(s.taps)).kernel("sum_taps"),
                    Arguments()
                        .add(in)
                        .add(out)
                        .add(device_.upload(s.offsets))
                        .add(device_.upload(s.weights))
                        .add(std::uint32_t(runs))
                        .add(std::uint32_t(rows.count()))
                        .add(groups)
                        .add(std::uint32_t(s.planes))
                        .add(std::uint32_t(s.phases))
                        .add(std::uint32_t(rows.begin % s.phases))
                        .add(std::uint32_t(in_first))
                        .add(std::uint32_t(in_step))
                        .add(std::uint32_t(out_first))
                        .add(std::uint32_t(shape.stride))
                        .add(std::uint32_t(shape.plane)),
                    runs * groups * s.planes);
    };
    if (plan_.separable()) {
        const PlaneShape between{bins_.stride, bins_.stride * rows.count()};
        const PlaneSums down_sums = plan_.down_sums(bins_);
        reserve(sums_, down_sums.planes * between.plane * sizeof(float));
        sum(down_sums, planes_, sums_, bins_.stride / shape_.lanes, own_row, source_.bins_y * bins_.stride, 0,
            between);
        sum(plan_.across_sums(between), sums_, drives, runs(), plan_.left(), between.stride,
            first_of(rows.begin, made), drives_);
    } else {
        sum(plan_.sums(bins_), planes_, drives, runs(), own_row + plan_.left(), source_.bins_y * bins_.stride,
            first_of(rows.begin, made), drives_);
    }
}

/// The refinement of rows `made`; those within its reach of a border that is not the picture's are not final.
Buffer DisplayPipeline::refine(const Buffer& asked, const Rows& made, std::size_t bytes) {
    const Buffer shown = device_.allocate(bytes);
    Buffer turned = device_.allocate(bytes), next = device_.allocate(bytes);
    device_.fill_zero(turned);
    device_.fill_zero(next);
    const PlaneSums sums = refine_sums(*settings_.refine, drives_);
    const Program program = device_.build("subpixel/drives.cl", options(sums.taps));
    const Buffer offsets = device_.upload(sums.offsets), weights = device_.upload(sums.weights);
    const std::uint32_t groups = row_groups(made.count(), sums);
    const std::size_t items = std::size_t(runs()) * groups * sums.planes;
    const auto shape = [&](Arguments arguments) {
        return arguments.add(runs())
            .add(std::uint32_t(made.count()))
            .add(groups)
            .add(std::uint32_t(sums.planes))
            .add(std::uint32_t(sums.phases))
            .add(std::uint32_t(made.begin % sums.phases))
            .add(first_of(made.begin, made))
            .add(std::uint32_t(drives_.stride))
            .add(std::uint32_t(drives_.plane))
            .add(std::uint32_t(source_.width))
            .add(std::uint32_t(plan_.cell_x()));
    };
    device_.run(program.kernel("refine_begin"), shape(Arguments().add(asked).add(shown).add(turned)), items);
    for (unsigned step = 0; step < refine_steps_; ++step) {
        device_.run(program.kernel("refine_step"),
                    shape(Arguments().add(asked).add(shown).add(turned).add(next).add(offsets).add(weights)),
                    items);
        std::swap(turned, next);
    }
    return shown;
}

}  // namespace triad
