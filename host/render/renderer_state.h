#pragma once
/// The inside of Renderer, shared by the files that implement it.
#include <chrono>

#include "render/film_store.h"
#include "render/renderer.h"
#include "scene/film_sets.h"
#include "scene/sample_shares.h"

namespace triad {

using RenderClock = std::chrono::steady_clock;
inline double seconds_since(RenderClock::time_point start) {
    return std::chrono::duration<double>(RenderClock::now() - start).count();
}

struct Renderer::State {
    std::shared_ptr<const PackedScene> packed;
    double pilot_seconds = 0;  ///< that the choice of photons took
    RenderSettings settings;
    Features features;
    FilmStore store;
    Tracers tracers;
    double build_seconds = 0, compile_seconds = 0;
    double photon_seconds = 0;  ///< that photons and their maps took
    SetSamples have;            ///< what each set of the film holds, of all ranges; empty: nothing yet
    SampleShares shares;        ///< of these; without sets: one device took all
    std::optional<FilmProgress> progress;  ///< of a render that stopped before its goal

    State(const DeviceScenes& scenes, const RenderSettings& settings,
          const std::optional<Features>& features);

    /// Of a film that this one goes on from, whose samples `have` counts.
    void go_on_with_devices_of(const Film& film);
    /// Whose device has not failed.
    Tracer& first_alive() const;
    std::uint64_t photons() const { return tracers.front()->photons().count(); }
    const Film& film() const { return store.film(); }
};

}  // namespace triad
