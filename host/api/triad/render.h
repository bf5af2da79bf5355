#pragma once
/// From a scene to a film.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "triad/film.h"
#include "triad/scene.h"

namespace triad::api {

struct Settings {
    unsigned width = 0, height = 0;  ///< pixels; both 0: 720 rows in the aspect of the camera, or 1280x720
    /// Samples per pixel; none: 64, or as option "error" or "time" wants.
    std::optional<std::uint64_t> spp{};
    std::uint32_t seed = 0;  ///< of the random numbers
    std::string device{};    ///< number, "cpu", "gpu", part of a name, or "all"; empty: the usual
    /// All other options of `triad render`, but those for load() and "output", "json", "progress", "pixel",
    /// "frames" and "fps".
    Options options{};
};

/// How far a render is.
struct Progress {
    double done = 0;                       ///< of the whole, 0 to 1
    double seconds = 0;                    ///< since rendering began
    std::optional<double> seconds_left{};  ///< none: not known yet
    double spp = 0;                        ///< samples per pixel so far
    std::optional<double> relmse{};        ///< as Film::relmse()
};

/// Called some times a second by the thread that called render(); false stops the render, whose film is then
/// not complete. What it throws stops the render too, and is thrown by render().
using Report = std::function<bool(const Progress&)>;

/// Renders. The first render on a device compiles its kernels, checks the device by known answers and
/// measures what suits it, which takes up to a minute and is kept in the user's cache folder. Calls from
/// several threads wait for each other. Throws Error.
TRIAD_API Film render(const Scene& scene, const Settings& settings = {}, const Report& report = {});
/// The same of a file; options of load() go with the others.
TRIAD_API Film render(const std::filesystem::path& path, const Settings& settings = {},
                      const Report& report = {});

}  // namespace triad::api
