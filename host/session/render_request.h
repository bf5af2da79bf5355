#pragma once
/// What a render is asked for, as plain data; nothing here touches a scene or a device.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/math.h"
#include "bvh/bvh.h"
#include "pack/settings.h"
#include "render/schedule.h"
#include "scene/look.h"
#include "session/output.h"
#include "session/reconstruct_request.h"
#include "trace/path_driver.h"

namespace triad {

/// What the fixed point of the film has room for.
constexpr std::uint64_t most_samples = 1u << 30;

/// The picture where none is named.
constexpr const char* default_output = "triad.png";

struct RenderRequest {
    std::string scene_path;  ///< empty: the built-in scene
    std::vector<std::string> outputs;
    std::string film_path, json_path, kernels_path;
    std::string resume_path;           ///< a film to go on from
    std::optional<double> checkpoint;  ///< seconds between two films that are written while rendering
    /// How a command line asked for this picture and this goal: kept with a film that is not complete.
    std::vector<std::string> words;
    bool profile = false;    ///< events of all that devices do: Device::commands()
    bool in_memory = false;  ///< what render() returns is wanted: no picture need be named
    bool force = false;      ///< render on a device that computes wrong answers
    std::optional<uvec2> size;
    std::optional<std::array<unsigned, 4>> crop;
    std::optional<std::array<unsigned, 2>>
        pixel;                         ///< tell everything about this one instead of making a picture
    std::optional<std::uint64_t> spp;  ///< 64 where nothing else ends the render
    std::optional<double> error, time;
    std::optional<bool> adaptive;
    std::optional<SampleRange> samples;
    std::optional<std::array<unsigned, 2>> share;  ///< the I-th (from 0) of K equal parts of spp
    std::uint32_t seed = 0;
    unsigned max_depth = 0;
    double roulette = RenderSettings{}.roulette;
    Integrator integrator = Integrator::automatic;
    std::uint64_t photons = 0;
    bool aim_photons = true, final_gather = true;
    double photon_radius = 0;  ///< the last four: as in RenderSettings
    bool independent = false;  ///< samples, instead of Sobol's sequence
    bool texture_levels = true;
    Spectral spectral = Spectral::automatic;
    ReconstructRequest reconstruct;
    std::string device;
    unsigned threads = 0;
    std::optional<BvhFormat> format;            ///< of nodes; none: the device's own
    std::optional<PathDriverKind> path_driver;  ///< none: the device's own

    int scene_index = -1;
    bool strict = false;                  ///< damaged data of a scene end it
    std::optional<unsigned> max_texture;  ///< texels on the longer side; 0: any; none: what fits
    std::string camera;
    std::optional<std::array<double, 6>> look_at;
    /// Degrees from the front to the right and upwards, and how much larger than framed.
    std::optional<std::array<double, 3>> orbit;
    std::optional<double> fov;  ///< vertical, degrees
    std::optional<double> aperture, focus;

    std::string variant;                ///< of the file's materials; empty: none
    std::string animation;              ///< name, index, "none"; empty: the first
    double pose_time = 0;               ///< seconds of it
    std::optional<SampleRange> frames;  ///< a picture of each, frame k at k / fps seconds
    double fps = 24;
    double point_size = 1.5;         ///< pixels: width of points and lines
    std::vector<std::string> glass;  ///< MATERIAL=NAME
    std::string env_path;
    std::optional<Look> look;    ///< none: studio where the scene has no light
    std::optional<bool> ground;  ///< none: below a scene that has neither light nor camera of its own
    double env_rotate = 0;       ///< degrees
    double env_strength = 1;
    bool transparent = false;
    OutputStyle style;  ///< exposure, tone map, background colour, half; complete() adds the reconstruction
    std::vector<std::string> aovs;
    std::string progress = "auto";

    /// What ends the render.
    RenderGoal goal() const;
    /// Every file that is written, and every one that is named to be read; some empty
    /// (base/check_outputs.h).
    std::vector<std::string> outputs_named() const;
    std::vector<std::string> inputs_named() const;
};

/// Fills in the default output and checks what the members say together, in the words of the command line.
/// Throws Error(usage).
void complete(RenderRequest& request);

}  // namespace triad
