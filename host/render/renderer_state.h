#pragma once
/// The inside of Renderer, shared by the files that implement it.
#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "kernels/types.h"
#include "render/pack.h"
#include "render/photon_map.h"
#include "render/renderer.h"

namespace triad {

using RenderClock = std::chrono::steady_clock;
inline double seconds_since(RenderClock::time_point start) {
    return std::chrono::duration<double>(RenderClock::now() - start).count();
}

/// Tiles of a launch at most. PoCL compiles a kernel a second time for grids beyond 65,535 items; below,
/// there is one program for everything, and compiling is over before rendering begins.
constexpr std::size_t largest_launch = 65535 / FILM_TILE_PIXELS;

/// The program of kernels/path/ that follows (or records) paths with these settings.
inline std::string program_of(const RenderSettings& settings, const std::string& what) {
    return "path/" + what + (settings.spectral == Spectral::full ? "_full.cl" : ".cl");
}

struct Renderer::State {
    Device& device;
    RenderSettings settings;
    PackedScene packed;  // arrays are cleared once they are on the device
    dev::Frame frame{};
    DeviceScene scene;
    Features features;
    Kernel trace_paths, trace_photons;
    /// Of the film: bands of rows of tiles, from the top, so that no piece is larger than the device allows.
    struct Band {
        Buffer sums, half_sums;
    };
    std::vector<Band> bands;
    std::size_t band_tiles = 0;  ///< of each but the last
    Buffer samples, counters;
    Buffer photon_frame, photon_lights, casters;
    Buffer photon_tiles;           ///< which tiles get the sample that photons belong to
    PhotonMap map;                 ///< none: nothing is gathered
    std::uint64_t photons = 0;     ///< with every sample of the picture, or in all for the classic map
    bool has_classic_map = false;  ///< of this seed
    double photon_seconds = 0;     ///< that photons and their maps took
    Buffer work;                   ///< of a pass: one dev::TileWork for every tile
    std::size_t tiles = 0;         ///< of the crop
    Film film;                     ///< without the arrays
    std::vector<std::string> source_names;    ///< see Renderer::light_sources()
    std::vector<std::uint32_t> light_source;  ///< of each dev::Light
    double build_seconds = 0, compile_seconds = 0;
    double items_per_second = 0;  ///< samples, measured over the last launches

    State(Device& d, const RenderSettings& s) : device(d), settings(s) {}

    /// Of the film's arrays; the device's are not filled.
    void allocate_film();
    /// Renders work[first, first + count), all of one band, whose samples are counted from first_sample.
    void launch(std::size_t first, std::size_t count, std::uint64_t first_sample, std::size_t band);
    /// Allocates what the scene's arguments need of photons; before it is uploaded.
    void allocate_photons();
    /// Uploads what else photons need and compiles their kernels, where the scene wants them.
    void prepare_photons();
    /// Which tiles of the crop the next photons count in.
    void set_photon_tiles(const std::vector<std::uint32_t>& tiles);
    /// Traces the photons of a sample of the picture, `count` of them standing for all: to the film, and into
    /// the map where paths gather.
    void launch_photons(std::uint64_t sample, std::uint64_t count);
    bool is_classic() const { return packed.chosen == Integrator::photon_map; }
    void clear_film();
    void name_settings();  ///< in the film
    /// Fills source_names and light_source; before the packed arrays go.
    void name_sources(const Scene& from);
    void load_film_arrays();
};

}  // namespace triad
