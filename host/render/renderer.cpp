#include "render/renderer.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "base/memory_limit.h"
#include "base/spans.h"
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

/// On the host and on every device; of several, one at a time lies on the host once more; and what an
/// estimate of the error takes.
void require_film_memory(const RenderSettings& s, std::size_t devices) {
    constexpr std::uint64_t of_estimate = 40;  // bytes of a pixel
    const std::uint64_t pixels =
        s.crop[2] ? std::uint64_t(s.crop[2]) * s.crop[3] : std::uint64_t(s.width) * s.height;
    const std::uint64_t films = devices > 1 ? devices + 2 : 2;
    require_memory(pixels * ((32 * s.bins_x * s.bins_y + 28) * films + of_estimate),
                   "The film of " + std::to_string(pixels) + " pixels");
}

/// What work() returns, and how long it took.
template <class Work>
auto timed(double& seconds, const Work& work) {
    const auto start = RenderClock::now();
    auto result = work();
    seconds = seconds_since(start);
    return result;
}

/// Settings that are asked for and are not those of the film that is to go on, by name. Throws Error.
void require_same_settings(const Film& here, const Film& film) {
    if (here.scene != film.scene)
        throw Error(Exit::scene,
                    "The film is of another scene than the one that was named (none: the built-in scene), or "
                    "that scene's file has changed since.");
    if (here.settings_text == film.settings_text) return;
    const auto settings_of = [](const Film& f) {
        const auto parsed = nlohmann::json::parse(f.settings_text, nullptr, false);
        return parsed.is_object() ? parsed : nlohmann::json::object();
    };
    const nlohmann::json mine = settings_of(here), its = settings_of(film);
    std::string differences;
    for (const auto& [name, value] : mine.items()) {
        if (its.contains(name) && its[name] == value) continue;
        differences += (differences.empty() ? "" : ", ") + name + " " +
                       (its.contains(name) ? its[name].dump() : "(unknown)") + " there and " + value.dump() +
                       " here";
    }
    throw Error(Exit::usage, "The film was rendered with other settings" +
                                 (differences.empty() ? "" : ": " + differences) + ".");
}

/// False: of several devices this one cannot do it and is left out, which a warning tells.
bool try_device(std::size_t devices, const std::function<void()>& work) {
    if (devices == 1) return work(), true;
    try {
        work();
        return true;
    } catch (const Error& error) {
        warn(std::string(error.what()) + " The device is left out.");
        return false;
    }
}

DeviceScenes scene_on(std::span<Device* const> devices, const Scene& scene, const RenderSettings& settings) {
    const Span span("build trees and upload", "build");
    BvhFormats formats;
    for (const Device* device : devices) formats.insert(format_of(*device));
    const auto packed = pack_for(scene, settings, {}, formats);
    DeviceScenes scenes;
    for (Device* device : devices)
        try_device(devices.size(), [&] { scenes.push_back(std::make_shared<DeviceScene>(*device, packed)); });
    if (scenes.empty()) throw Error(Exit::device, "No device is left to render on.");
    return scenes;
}

}  // namespace

Renderer::State::State(const DeviceScenes& scenes, const RenderSettings& s, const std::optional<Features>& f)
    : packed(scenes.front()->shared()),
      settings(timed(pilot_seconds, [&] { return with_photon_pilot(scenes, s); })),
      features(f ? united(*f, features_of(*packed, settings)) : features_of(*packed, settings)),
      store(*packed, settings) {
    assert(holds_for(*packed, s));
    const Span span("compile", "compile");
    const auto start = RenderClock::now();
    for (const auto& scene : scenes) {
        assert(scene->shared() == packed);
        if (!try_device(scenes.size(), [&] {
                tracers.push_back(std::make_unique<Tracer>(scene, settings, features, store.film()));
            }))
            continue;
        store.add_device(scene->device().info());
    }
    if (tracers.empty()) throw Error(Exit::device, "No device is left to render on.");
    compile_seconds = seconds_since(start);
}

Tracer& Renderer::State::first_alive() const {
    for (const auto& tracer : tracers)
        if (!tracer->failure) return *tracer;
    return *tracers.front();
}

void Renderer::State::go_on_with_devices_of(const Film& film) {
    for (const std::string& words : film.devices) store.add_device(words);
    const std::vector<std::string>& all = store.film().devices;
    if (all.size() < 2) return;
    std::vector<std::uint32_t> places;
    for (const std::string& words : film.devices)
        places.push_back(std::uint32_t(std::find(all.begin(), all.end(), words) - all.begin()));
    if (!film.shares.empty()) {
        shares = SampleShares::unpacked(film.shares, have.size());
        shares.rename(places);
        return;
    }
    shares = SampleShares(have.size());
    const std::uint32_t device = places.size() == 1 ? places[0] : SampleShares::several;
    for (std::size_t set = 0; set < have.size(); ++set) shares.add(set, device, have[set]);
}

Renderer::Renderer(Device& device, const Scene& scene, const RenderSettings& settings,
                   const std::optional<Features>& features)
    : Renderer(std::vector<Device*>{&device}, scene, settings, features) {}

Renderer::Renderer(const std::vector<Device*>& devices, const Scene& scene, const RenderSettings& settings,
                   const std::optional<Features>& features) {
    check(settings);
    require_film_memory(settings, devices.size());
    const auto start = RenderClock::now();
    const DeviceScenes scenes = scene_on(devices, scene, settings);
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
    s.have.clear();
    s.shares = SampleShares();
    s.progress.reset();
}

void Renderer::gather() {
    State& s = *state_;
    if (s.tracers.size() == 1 || s.film().sums.empty()) s.store.gather(s.tracers);  // else all is delivered
}

Film Renderer::film() {
    gather();
    return merge(std::span<const Film>(&state_->film(), 1));
}

Film Renderer::take_film() {
    gather();
    return state_->store.take();
}

void Renderer::resume(const Film& film) {
    State& s = *state_;
    Film empty = s.film();
    empty.sums.clear(), empty.half_sums.clear(), empty.samples.clear(), empty.ranges.clear();
    require_same_settings(empty, film);
    require_same_picture(empty, film, "The film is not of this picture");
    for (auto& tracer : s.tracers) {
        if (tracer->photons().is_classic()) tracer->photons().make_classic_map(tracer->part());
        tracer->part().clear();  // of the map's counters as well: the film's are loaded
    }
    if (s.tracers.size() == 1)
        s.tracers.front()->part().load(film);
    else
        s.store.begin_with(film);
    s.store.set_ranges(film.ranges);
    s.have = samples_of_sets(film);
    s.go_on_with_devices_of(film);
    s.progress = film.progress;
}

FeaturePlanes Renderer::feature_planes(unsigned samples) {
    return triad::feature_planes(state_->first_alive(), samples);
}

void Renderer::record_pixel(unsigned x, unsigned y, SampleRange range,
                            const std::function<void(const RecordedPath&)>& receive) {
    record_paths(state_->first_alive(), x, y, range, receive);
}

WorkCounts Renderer::count_work(unsigned samples) {
    return triad::count_work(state_->first_alive(), samples);
}

std::vector<double> Renderer::time_tiles(unsigned samples, double most_seconds) {
    return triad::time_tiles(state_->first_alive(), tile_count(state_->film().width, state_->film().height),
                             samples, most_seconds);
}

MemoryUse Renderer::device_memory() const { return state_->first_alive().memory(); }

Device& Renderer::device() const { return state_->first_alive().device(); }
const FilmPart& Renderer::film_part() const { return state_->first_alive().part(); }
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
