#include "session/render_request.h"

#include <algorithm>

#include "base/error.h"

namespace triad {

RenderGoal RenderRequest::goal() const {
    const bool ends_itself = error || time;
    const unsigned bins = style.reconstruction.bins_x * style.reconstruction.bins_y;
    const std::uint64_t limit = whole_bins(spp.value_or(ends_itself ? most_samples : 64), bins);
    return {.samples = samples.value_or(SampleRange{0, limit}),
            .error = error.value_or(0),
            .seconds = time.value_or(0),
            .adaptive = adaptive.value_or(ends_itself),
            .where_worth_it = !adaptive};
}

std::vector<std::string> RenderRequest::outputs_named() const {
    std::vector<std::string> all = outputs;
    all.insert(all.end(), {film_path, json_path});
    return all;
}

std::vector<std::string> RenderRequest::inputs_named() const {
    const bool goes_on = film_path == resume_path;  // that film is to be replaced
    return {scene_path, env_path, reconstruct.panel, kernels_path, goes_on ? "" : resume_path};
}

namespace {

/// What can be said of --denoise before anything is rendered; the film is asked again.
void check_denoise(const RenderRequest& o) {
    if (o.style.denoise == Denoiser::off) return;
    const std::string name = std::string("--denoise ") + name_of(o.style.denoise);
    if (o.pixel || o.profile) throw Error(Exit::usage, name + " is for pictures, and none is made here.");
    for (const char* of_samples : {"variance", "error"})
        if (std::find(o.aovs.begin(), o.aovs.end(), of_samples) != o.aovs.end())
            throw Error(Exit::usage,
                        "--aov " + std::string(of_samples) +
                            " tells of the samples, not of a denoised picture: leave it out, or " + name +
                            ".");
}

}  // namespace

void complete(RenderRequest& o) {
    if (o.frames && (o.pixel || o.pose_time != 0))
        throw Error(
            Exit::usage,
            "--frames makes many pictures, each at its own moment: it cannot be combined with --pixel "
            "or --pose-time.");
    if (o.frames && (std::count(o.outputs.begin(), o.outputs.end(), "-") > 0 || o.json_path == "-"))
        throw Error(Exit::usage, "--frames numbers its files: none can go to standard output.");
    if (o.pixel && (!o.outputs.empty() || !o.film_path.empty() || o.crop || o.error || o.time || o.adaptive))
        throw Error(
            Exit::usage,
            "--pixel makes no picture: it cannot be combined with -o, --film, --crop, --error, --time or "
            "--adaptive.");
    if (o.integrator != Integrator::automatic && o.integrator != Integrator::path &&
        (o.pixel || o.adaptive.value_or(false)))
        throw Error(
            Exit::usage,
            "Photons light the picture as a whole: --integrator photons, light and photon-map cannot be "
            "combined with --pixel or --adaptive on; use --integrator path there.");
    if (o.pixel || o.adaptive.value_or(false)) o.integrator = Integrator::path;
    if (o.integrator == Integrator::path && (o.photons || o.photon_radius > 0 || !o.aim_photons))
        throw Error(Exit::usage,
                    "--photons, --photon-radius and --photon-aim are for photons, and here paths bring all "
                    "light: give "
                    "--integrator photons, light or photon-map.");
    if (o.integrator != Integrator::photon_map && !o.final_gather)
        throw Error(Exit::usage, "--final-gather is for --integrator photon-map.");
    if (!o.resume_path.empty() && o.film_path.empty()) o.film_path = o.resume_path;
    if (o.pixel && !o.film_path.empty())
        throw Error(Exit::usage, "--pixel makes no picture: it cannot be combined with --resume.");
    if (o.checkpoint && o.film_path.empty())
        throw Error(Exit::usage, "--checkpoint is how often a film is written: name one with --film.");
    // A film alone is a complete result: a part of a larger render.
    if (!o.pixel && !o.profile && !o.in_memory && o.outputs.empty() && o.film_path.empty())
        o.outputs.push_back(default_output);
    for (const std::string& path : o.outputs) check_format(path);
    if (std::find(o.aovs.begin(), o.aovs.end(), "all") != o.aovs.end())
        o.aovs = {"albedo", "normal", "position", "depth", "samples", "variance", "error"};
    const bool exr =
        std::any_of(o.outputs.begin(), o.outputs.end(), [](const std::string& path) { return is_exr(path); });
    if (!o.aovs.empty() && !exr && !o.in_memory)
        throw Error(Exit::usage, "--aov needs an .exr output to put the layers in; add -o FILE.exr.");
    check_denoise(o);
    if (o.share && (!o.spp || o.error || o.time || o.adaptive.value_or(false)))
        throw Error(
            Exit::usage,
            "--samples share:I/K is a part of --spp N: give that, and not --error, --time or --adaptive on.");
    if (!o.share && o.samples && (o.spp || o.error || o.time || o.adaptive.value_or(false)))
        throw Error(
            Exit::usage,
            "--samples names exactly what is rendered: it cannot be combined with --spp, --error, --time or "
            "--adaptive on.");
    o.style.reconstruction = o.reconstruct.make();
    check_format_for(o.style.reconstruction, o.outputs);
    const std::uint64_t bins = o.style.reconstruction.bins_x * o.style.reconstruction.bins_y;
    if (o.spp || o.samples)
        require_denoisable(
            o.style.denoise, bins,
            o.samples ? o.samples->end - o.samples->begin : whole_bins(*o.spp, unsigned(bins)));
    else
        require_denoisable(o.style.denoise, bins, 2 * bins);
    if (o.share) {
        const auto [i, k] = *o.share;
        const std::uint64_t turns = whole_bins(*o.spp, unsigned(bins)) / bins;
        o.samples = SampleRange{turns * i / k * bins, turns * (i + 1) / k * bins};
        if (o.samples->begin == o.samples->end)
            throw Error(Exit::usage, "--samples share:" + std::to_string(i) + "/" + std::to_string(k) +
                                         " has no samples of --spp " + std::to_string(*o.spp) + ".");
    }
    if (o.samples && o.samples->end - o.samples->begin > most_samples)
        throw Error(Exit::usage, "--samples: " + std::to_string(o.samples->end - o.samples->begin) +
                                     " samples of a pixel are more than the " + std::to_string(most_samples) +
                                     " that a render takes; render parts of them, and triad merge.");
    if (o.samples && (o.samples->begin % bins != 0 || o.samples->end % bins != 0))
        throw Error(Exit::usage, "--samples: with " + std::to_string(bins) +
                                     " bins per pixel, ranges begin and end at multiples of " +
                                     std::to_string(bins) + ", so that every bin has as many samples.");
    if (o.crop && ((*o.crop)[2] == 0 || (*o.crop)[3] == 0))
        throw Error(Exit::usage, "--crop: width and height must be at least 1.");
}

}  // namespace triad
