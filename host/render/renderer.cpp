#include "render/renderer.h"

#include <algorithm>

#include "base/error.h"
#include "base/hash.h"
#include "render/renderer_state.h"

namespace triad {
namespace {

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

void Renderer::State::allocate_film() {
    const std::size_t across = (film.width + FILM_TILE - 1) / FILM_TILE,
                      allowed = device.info().max_allocation;
    const std::size_t row_bytes = film.width * FILM_TILE * film.bins() * FILM_CHANNELS * sizeof(std::int64_t);
    const std::size_t rows = (film.height + FILM_TILE - 1) / FILM_TILE;
    const std::size_t fit =
        allowed > 0 ? std::clamp<std::size_t>(allowed / row_bytes, 1, rows) : rows;  // rows of tiles
    band_tiles = fit * across;
    for (std::size_t row = 0; row < rows; row += fit) {
        const std::size_t pixels =
            film.width * (std::min<std::size_t>((row + fit) * FILM_TILE, film.height) - row * FILM_TILE);
        bands.push_back({device.allocate(pixels * film.bins() * FILM_CHANNELS * sizeof(std::int64_t)),
                         device.allocate(pixels * 3 * sizeof(std::int64_t))});
        scene.bytes += bands.back().sums.bytes() + bands.back().half_sums.bytes();
    }
    samples = device.allocate(film.pixels() * sizeof(std::uint32_t));
    counters = device.allocate(2 * COUNTERS * sizeof(std::uint32_t));
    tiles = across * rows;
    work = device.allocate(tiles * sizeof(dev::TileWork));
    scene.bytes += samples.bytes() + work.bytes();
}

void Renderer::State::launch(std::size_t first, std::size_t count, std::uint64_t first_sample,
                             std::size_t band) {
    const std::size_t across = (film.width + FILM_TILE - 1) / FILM_TILE;
    const std::size_t first_pixel = band * band_tiles / across * FILM_TILE * film.width;
    device.run(trace_paths,
               Arguments()
                   .add(scene.arguments)
                   .add(bands[band].sums)
                   .add(bands[band].half_sums)
                   .add(samples)
                   .add(counters)
                   .add(work)
                   .add(std::uint32_t(first))
                   .add(std::uint32_t(count))
                   .add(std::uint32_t(first_sample))
                   .add(std::uint32_t(first_sample >> 32))
                   .add(std::uint32_t(first_pixel)),
               count * FILM_TILE_PIXELS);
}

void Renderer::State::clear_film() {
    for (const Band& band : bands) {
        device.fill_zero(band.sums);
        device.fill_zero(band.half_sums);
    }
    device.fill_zero(samples);
    device.fill_zero(counters);
}

void Renderer::State::name_settings() {
    film.settings_text = text_of(settings);
    film.settings = Hash().add(film.settings_text).hex();
}

void Renderer::State::load_film_arrays() {
    film.sums.resize(film.pixels() * film.bins() * FILM_CHANNELS);
    film.half_sums.resize(film.pixels() * 3);
    std::size_t sum = 0, half_sum = 0;
    for (const Band& band : bands) {
        device.read(band.sums, &film.sums[sum], band.sums.bytes());
        device.read(band.half_sums, &film.half_sums[half_sum], band.half_sums.bytes());
        sum += band.sums.bytes() / sizeof(std::int64_t);
        half_sum += band.half_sums.bytes() / sizeof(std::int64_t);
    }
    film.samples = device.download<std::uint32_t>(samples);
    const auto words = device.download<std::uint32_t>(counters);
    for (std::size_t i = 0; i < COUNTERS; ++i)
        film.counters[i] = words[2 * i] | std::uint64_t(words[2 * i + 1]) << 32;
}

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
                   const std::optional<Features>& features) {
    check(settings);
    state_ = std::make_unique<State>(device, settings);
    State& s = *state_;

    const auto build_start = RenderClock::now();
    s.packed = pack(scene, settings);
    s.frame = frame_of(s.packed, settings);
    s.build_seconds = seconds_since(build_start);
    s.features = features ? *features : features_of(scene, settings, s.packed);
    s.allocate_photons();
    s.scene = upload(device, s.packed, settings, s.map.buffers());
    s.name_sources(scene);

    Film& f = s.film;
    f.full_width = settings.width, f.full_height = settings.height;
    f.x = s.frame.crop[0], f.y = s.frame.crop[1], f.width = s.frame.crop[2], f.height = s.frame.crop[3];
    f.bins_x = settings.bins_x, f.bins_y = settings.bins_y;
    f.quanta_log2 = s.packed.quanta_log2;
    f.scene = hash_of(scene);
    s.name_settings();
    f.devices = {device.info().name + ", " + device.info().driver};
    s.allocate_film();

    const auto compile_start = RenderClock::now();
    s.trace_paths = device.build(program_of(settings, "mega"), options_of(s.features)).kernel("trace_paths");
    // Some drivers generate code at the first launch: one tile, thrown away, keeps that out of render times.
    s.clear_film();
    const dev::TileWork first_tile{0, {0, 0}, {1, 1}, {}};
    device.write(s.work, &first_tile, sizeof first_tile);
    s.prepare_photons();
    s.launch(0, 1, 0, 0);
    device.finish();
    s.clear_film();
    s.compile_seconds = seconds_since(compile_start);
    PackedScene light;  // what the device has now is not kept twice
    light.origin = s.packed.origin;
    light.duplicates = s.packed.duplicates;
    light.integrator = s.packed.integrator;
    light.chosen = s.packed.chosen;
    light.casters = s.packed.casters;
    light.photon_lights_shape = s.packed.photon_lights_shape;
    light.bounds = s.packed.bounds;
    s.packed = std::move(light);
}

Renderer::~Renderer() = default;

void Renderer::restart(std::uint32_t seed) {
    State& s = *state_;
    s.settings.seed = s.frame.seed = seed;
    s.device.write(s.scene.frame, &s.frame, sizeof s.frame);
    s.name_settings();
    s.clear_film();
    s.film.ranges.clear();
    s.has_classic_map = false;
}

Film Renderer::film() {
    state_->load_film_arrays();
    return merge(std::span<const Film>(&state_->film, 1));
}

Renderer::FeaturePlanes Renderer::feature_planes(unsigned samples) {
    State& s = *state_;
    const Kernel trace_features =
        s.device.build("path/features.cl", options_of(s.features)).kernel("trace_features");
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
const std::string& Renderer::integrator() const { return state_->packed.integrator; }
std::uint64_t Renderer::photons() const { return state_->photons; }
double Renderer::photon_seconds() const { return state_->photon_seconds; }
std::uint64_t Renderer::device_bytes() const { return state_->scene.bytes; }

}  // namespace triad
