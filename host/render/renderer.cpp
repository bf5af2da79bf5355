#include "render/renderer.h"

#include <cassert>

#include "base/error.h"
#include "render/photon_pilot.h"
#include "render/renderer_state.h"
#include "trace/node_format.h"

namespace triad {
namespace {

void check(const RenderSettings& s) {
    auto refuse = [](const std::string& what) { throw Error(Exit::usage, what); };
    if (s.width == 0 || s.height == 0) refuse("The picture has no pixels: --size needs two numbers above 0.");
    if (s.bins_x == 0 || s.bins_y == 0 || s.bins_x > FILM_MOST_BINS || s.bins_y > FILM_MOST_BINS)
        refuse("--bins needs two numbers from 1 to 16.");
    const auto& c = s.crop;
    if (c[2] && (c[3] == 0 || std::uint64_t(c[0]) + c[2] > s.width || std::uint64_t(c[1]) + c[3] > s.height))
        refuse("--crop lies outside the picture of " + std::to_string(s.width) + " x " +
               std::to_string(s.height) + " pixels.");
    if (std::uint64_t(s.width) * s.height > 0xffffffffull)
        refuse("The picture has more than 2^32 pixels; render crops of it.");
}

/// What work() returns, and how long it took.
template <class Work>
auto timed(double& seconds, const Work& work) {
    const auto start = RenderClock::now();
    auto result = work();
    seconds = seconds_since(start);
    return result;
}

DeviceScenes scene_on(Device& device, const Scene& scene, const RenderSettings& settings) {
    return {std::make_shared<DeviceScene>(device, pack_for(scene, settings, {}, {format_of(device)}))};
}

}  // namespace

Renderer::State::State(const DeviceScenes& scenes, const RenderSettings& s, const std::optional<Features>& f)
    : packed(scenes.front()->shared()),
      settings(timed(pilot_seconds, [&] { return with_photon_pilot(scenes, s); })),
      features(f ? *f : features_of(*packed, settings)),
      store(*packed, settings) {
    assert(holds_for(*packed, s));
    const auto start = RenderClock::now();
    for (const auto& scene : scenes) {
        assert(scene->shared() == packed);
        if (!tracers.empty() && photons() > 0) break;
        tracers.push_back(std::make_unique<Tracer>(scene, settings, features, store.film()));
        store.add_device(scene->device().info());
    }
    compile_seconds = seconds_since(start);
}

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
                   const std::optional<Features>& features) {
    check(settings);
    const auto start = RenderClock::now();
    const DeviceScenes scenes = scene_on(device, scene, settings);
    const double build_seconds = seconds_since(start);
    state_ = std::make_unique<State>(scenes, settings, features);
    state_->build_seconds = build_seconds;
}

Renderer::Renderer(const DeviceScenes& scenes, const RenderSettings& settings,
                   const std::optional<Features>& features) {
    check(settings);
    state_ = std::make_unique<State>(scenes, settings, features);
}

Renderer::~Renderer() = default;

void Renderer::restart(std::uint32_t seed) {
    State& s = *state_;
    s.settings.seed = seed;
    for (auto& tracer : s.tracers) tracer->restart(seed);
    s.store.restart(*s.packed, s.settings);
}

Film Renderer::film() {
    State& s = *state_;
    s.store.gather(s.tracers);
    return merge(std::span<const Film>(&s.film(), 1));
}

void Renderer::resume(const Film& film) {
    State& s = *state_;
    Film empty = s.film();
    empty.sums.clear(), empty.half_sums.clear(), empty.samples.clear(), empty.ranges.clear();
    require_same_picture(empty, film);
    for (auto& tracer : s.tracers) tracer->part().clear();
    s.tracers.front()->part().load(film);
    s.store.set_ranges(film.ranges);
}

FeaturePlanes Renderer::feature_planes(unsigned samples) {
    return triad::feature_planes(*state_->tracers.front(), samples);
}

void Renderer::record_pixel(unsigned x, unsigned y, SampleRange range,
                            const std::function<void(const RecordedPath&)>& receive) {
    record_paths(*state_->tracers.front(), x, y, range, receive);
}

const PackedScene& Renderer::packed() const { return *state_->packed; }
const Features& Renderer::features() const { return state_->features; }
double Renderer::build_seconds() const { return state_->build_seconds; }
double Renderer::compile_seconds() const { return state_->compile_seconds; }
std::string Renderer::integrator() const {
    const PackedScene& packed = *state_->packed;
    if (integrator_of(packed, state_->settings) == packed.chosen) return packed.integrator;
    return packed.photons_in_doubt ? "path: a pilot found photons not worth their work" : "path: as asked";
}
std::uint64_t Renderer::photons() const { return state_->photons(); }
double Renderer::pilot_seconds() const { return state_->pilot_seconds; }
double Renderer::photon_seconds() const { return state_->photon_seconds; }

std::uint64_t Renderer::device_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& tracer : state_->tracers) bytes += tracer->bytes();
    return bytes;
}

}  // namespace triad
