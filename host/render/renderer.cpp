#include "render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "kernels/types.h"
#include "render/pack.h"

namespace triad {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr double launch_seconds =
    0.05;  ///< watchdogs, cancelling and progress want short launches, overhead long ones
/// Tiles of a launch at most. PoCL compiles a kernel a second time for grids beyond 65,535 items; below,
/// there is one program for everything, and compiling is over before rendering begins.
constexpr std::size_t largest_launch = 65535 / FILM_TILE_PIXELS;

void check(const RenderSettings& s) {
    auto refuse = [](const std::string& what) { throw Error(Exit::usage, what); };
    if (s.width == 0 || s.height == 0) refuse("The picture has no pixels: --size needs two numbers above 0.");
    if (s.bins_x == 0 || s.bins_y == 0 || s.bins_x > 16 || s.bins_y > 16)
        refuse("--bins needs two numbers from 1 to 16.");
    const auto& c = s.crop;
    if (c[2] && (c[3] == 0 || std::uint64_t(c[0]) + c[2] > s.width || std::uint64_t(c[1]) + c[3] > s.height))
        refuse("--crop lies outside the picture of " + std::to_string(s.width) + " x " +
               std::to_string(s.height) + " pixels.");
    if (std::uint64_t(s.width) * s.height > 0xffffffffull)
        refuse("The picture has more than 2^32 pixels; render crops of it.");
}

}  // namespace

struct Renderer::State {
    Device& device;
    RenderSettings settings;
    PackedScene packed;  // arrays are cleared once they are on the device
    dev::Frame frame{};
    DeviceScene scene;
    Features features;
    Kernel trace_paths;
    Buffer sums, half_sums, samples, counters;
    Buffer work;            ///< of a pass: one dev::TileWork for every tile
    std::size_t tiles = 0;  ///< of the crop
    Film film;              ///< without the arrays
    double build_seconds = 0, compile_seconds = 0;
    double items_per_second = 0;  ///< samples, measured over the last launches

    State(Device& d, const RenderSettings& s) : device(d), settings(s) {}

    Arguments film_arguments() const {
        return Arguments().add(scene.arguments).add(sums).add(half_sums).add(samples).add(counters);
    }

    /// Renders work[first, first + count), whose samples are counted from first_sample.
    void launch(std::size_t first, std::size_t count, std::uint64_t first_sample) {
        device.run(trace_paths,
                   film_arguments()
                       .add(work)
                       .add(std::uint32_t(first))
                       .add(std::uint32_t(count))
                       .add(std::uint32_t(first_sample))
                       .add(std::uint32_t(first_sample >> 32)),
                   count * FILM_TILE_PIXELS);
    }

    void clear_film() {
        for (const Buffer* b : {&sums, &half_sums, &samples, &counters}) device.fill_zero(*b);
    }

    std::array<std::uint64_t, COUNTERS> read_counters() {
        const auto words = device.download<std::uint32_t>(counters);
        std::array<std::uint64_t, COUNTERS> values{};
        for (std::size_t i = 0; i < COUNTERS; ++i)
            values[i] = words[2 * i] | std::uint64_t(words[2 * i + 1]) << 32;
        return values;
    }

    /// One pass: samples [first, first + count) of every pixel, in launches of about launch_seconds.
    void pass(std::uint64_t first, unsigned count) {
        std::vector<dev::TileWork> all(tiles);
        for (std::size_t t = 0; t < tiles; ++t) all[t] = {std::uint32_t(t), {0, 0}, {count, count}, {}};
        device.write(work, all.data(), tiles * sizeof(dev::TileWork));
        for (std::size_t tile = 0; tile < tiles;) {
            const double fit = items_per_second * launch_seconds / count / FILM_TILE_PIXELS;
            const std::size_t wanted =
                items_per_second > 0 ? static_cast<std::size_t>(std::max(std::ceil(fit), 1.0)) : 16;
            const std::size_t n = std::min({tiles - tile, wanted, largest_launch});
            const auto start = Clock::now();
            launch(tile, n, first);
            device.finish();
            const double samples = static_cast<double>(n) * FILM_TILE_PIXELS * count;
            const double rate = samples / std::max(since(start), 1e-6);
            // Small launches are dominated by overhead and must not make the next ones smaller still.
            items_per_second = items_per_second > 0 ? std::max(0.5 * (items_per_second + rate), rate) : rate;
            tile += n;
        }
    }

    void load_film_arrays() {
        film.sums = device.download<std::int64_t>(sums);
        film.half_sums = device.download<std::int64_t>(half_sums);
        film.samples = device.download<std::uint32_t>(samples);
        film.counters = read_counters();
    }
};

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
                   const std::optional<Features>& features) {
    check(settings);
    state_ = std::make_unique<State>(device, settings);
    State& s = *state_;

    const auto build_start = Clock::now();
    s.packed = pack(scene, settings);
    s.frame = frame_of(s.packed, settings);
    s.build_seconds = since(build_start);
    s.features = features ? *features : features_of(scene, settings, s.packed.instances);
    s.scene = upload(device, s.packed, settings);

    Film& f = s.film;
    f.full_width = settings.width, f.full_height = settings.height;
    f.x = s.frame.crop[0], f.y = s.frame.crop[1], f.width = s.frame.crop[2], f.height = s.frame.crop[3];
    f.bins_x = settings.bins_x, f.bins_y = settings.bins_y;
    f.quanta_log2 = s.packed.quanta_log2;
    f.scene = hash_of(scene);
    f.settings_text = text_of(settings);
    f.settings = Hash().add(f.settings_text).hex();
    f.devices = {device.info().name + ", " + device.info().driver};
    s.tiles = std::size_t((f.width + FILM_TILE - 1) / FILM_TILE) * ((f.height + FILM_TILE - 1) / FILM_TILE);
    s.sums = device.allocate(f.pixels() * f.bins() * FILM_CHANNELS * sizeof(std::int64_t));
    s.half_sums = device.allocate(f.pixels() * 3 * sizeof(std::int64_t));
    s.samples = device.allocate(f.pixels() * sizeof(std::uint32_t));
    s.counters = device.allocate(2 * COUNTERS * sizeof(std::uint32_t));
    s.work = device.allocate(s.tiles * sizeof(dev::TileWork));
    s.scene.bytes += s.sums.bytes() + s.half_sums.bytes() + s.samples.bytes() + s.work.bytes();

    const auto compile_start = Clock::now();
    s.trace_paths = device.build("shading/path.cl", options_of(s.features)).kernel("trace_paths");
    // Some drivers generate code at the first launch: one tile, thrown away, keeps that out of render times.
    s.clear_film();
    const dev::TileWork first_tile{0, {0, 0}, {1, 1}, {}};
    device.write(s.work, &first_tile, sizeof first_tile);
    s.launch(0, 1, 0);
    device.finish();
    s.clear_film();
    s.compile_seconds = since(compile_start);
    PackedScene light;  // what the device has now is not kept twice
    light.origin = s.packed.origin;
    light.duplicates = s.packed.duplicates;
    s.packed = std::move(light);
}

Renderer::~Renderer() = default;

SampleRange Renderer::render(SampleRange range, const std::function<bool(const Progress&)>& report) {
    State& s = *state_;
    const auto start = Clock::now();
    double next_estimate = 0.25;
    Progress progress{.samples_wanted = range.end - range.begin};
    std::uint64_t at = range.begin;
    while (at < range.end) {
        // A pass is as many samples as fit a launch; at least one, at most a quarter second's worth.
        const double fit =
            s.items_per_second * 4 * launch_seconds / static_cast<double>(s.tiles * FILM_TILE_PIXELS);
        const std::uint64_t count = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(fit), 1,
                                                              std::min<std::uint64_t>(range.end - at, 256));
        s.pass(at, static_cast<unsigned>(count));
        at += count;
        s.film.ranges.push_back({at - count, at});
        progress.samples_done = at - range.begin;
        progress.seconds = since(start);
        if (progress.seconds >= next_estimate || at == range.end) {
            s.load_film_arrays();
            progress.relmse = estimated_relmse(s.film);
            progress.rays = s.film.counters[COUNTER_RAYS];
            // Estimating reads the whole film: spend a small share of the time on it.
            const double cost = since(start) - progress.seconds;
            next_estimate = since(start) + std::max(1.0, 20 * cost);
            progress.seconds = since(start);
        }
        if (!report(progress)) break;
    }
    return {range.begin, at};
}

Film Renderer::film() {
    state_->load_film_arrays();
    return merge(std::span<const Film>(&state_->film, 1));
}

Renderer::FeaturePlanes Renderer::feature_planes(unsigned samples) {
    State& s = *state_;
    const Kernel trace_features =
        s.device.build("shading/features.cl", options_of(s.features)).kernel("trace_features");
    const std::size_t pixels = s.film.pixels();
    Buffer planes[4];
    for (int i = 0; i < 4; ++i) planes[i] = s.device.allocate(pixels * (i == 3 ? 1 : 3) * sizeof(float));
    Arguments arguments = s.scene.arguments;
    for (const Buffer& b : planes) arguments.add(b);
    const std::size_t items = s.tiles * FILM_TILE_PIXELS;
    const std::size_t chunk =
        std::clamp<std::size_t>((std::size_t(1) << 20) / samples / FILM_TILE_PIXELS, 1, largest_launch) *
        FILM_TILE_PIXELS;
    for (std::size_t pixel = 0; pixel < items; pixel += chunk) {
        const std::size_t count = std::min(chunk, items - pixel);
        s.device.run(trace_features,
                     Arguments()
                         .add(arguments)
                         .add(std::uint32_t(pixel))
                         .add(std::uint32_t(count))
                         .add(std::uint32_t(samples)),
                     count);
        s.device.finish();
    }
    FeaturePlanes out{s.device.download<float>(planes[0]), s.device.download<float>(planes[1]),
                      s.device.download<float>(planes[2]), s.device.download<float>(planes[3])};
    for (std::size_t i = 0; i < pixels * 3; ++i)
        out.position[i] = static_cast<float>(out.position[i] + s.packed.origin[static_cast<int>(i % 3)]);
    return out;
}

const Features& Renderer::features() const { return state_->features; }
double Renderer::build_seconds() const { return state_->build_seconds; }
double Renderer::compile_seconds() const { return state_->compile_seconds; }
std::uint64_t Renderer::device_bytes() const { return state_->scene.bytes; }

}  // namespace triad
