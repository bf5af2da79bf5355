#include "session/render_session.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "base/check_outputs.h"
#include "base/files.h"
#include "base/log.h"
#include "base/parallel_for.h"
#include "base/spans.h"
#include "check/verdict.h"
#include "display/perceived_noise.h"
#include "display/perceived_sets.h"
#include "io/io.h"
#include "session/prepare.h"

namespace triad {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code failed;
    return a == b || std::filesystem::equivalent(a, b, failed);
}

/// Everything that can be wrong is found before the long part.
RenderRequest checked(RenderRequest request) {
    complete(request);
    refuse_folder(request.scene_path);
    check_outputs(request.outputs_named(), request.inputs_named());
    prepare_to_write(request.outputs);
    const std::string& film = request.film_path;
    if (is_file(film) && !is_same_file(film, request.resume_path))
        throw Error(Exit::usage, "The film " + film + " is there already: triad render --resume " + film +
                                     " goes on with it. Remove it, or name another one, to begin again.");
    set_host_threads(request.threads);
    kernel_source::set_folder(request.kernels_path);
    return request;
}

/// None for what is no file: nothing else is replaced, or goes on.
std::unique_ptr<FileLock> lock_of(const RenderRequest& request) {
    const std::string& film = request.film_path;
    if (film.empty() || (is_there(film) && !is_file(film))) return nullptr;
    auto lock = std::make_unique<FileLock>(film);
    remove_leftovers(film, true);
    return lock;
}

OpenDevices opened(const RenderRequest& o, OpenDevices* kept, bool& check_is_due) {
    if (kept && *kept) return *kept;
    // A check beside the picture would disturb these.
    const bool before = o.threads > 0 || o.goal().seconds > 0 || o.profile;
    return std::make_shared<std::vector<Device>>(open_devices(o, before ? nullptr : &check_is_due));
}

std::vector<Device*> pointers(std::vector<Device>& devices) {
    std::vector<Device*> all;
    for (Device& device : devices) all.push_back(&device);
    return all;
}

LoadedScene timed_scene(const RenderRequest& request, std::optional<LoadedScene> before, double& seconds) {
    const Span span("load the scene", "load");
    const auto start = Clock::now();
    LoadedScene loaded = before ? std::move(*before) : read_scene(request);
    prepare_scene(request, loaded.scene);
    seconds = since(start);
    return loaded;
}

}  // namespace

RenderSession::RenderSession(RenderRequest request, OpenDevices* kept)
    : RenderSession(std::move(request), std::optional<LoadedScene>(), kept) {}

RenderSession::RenderSession(RenderRequest request, LoadedScene loaded, OpenDevices* kept)
    : RenderSession(std::move(request), std::optional(std::move(loaded)), kept) {}

RenderSession::RenderSession(RenderRequest request, std::optional<LoadedScene> loaded, OpenDevices* kept)
    : request_(checked(std::move(request))),
      lock_(lock_of(request_)),
      loaded_(timed_scene(request_, std::move(loaded), load_seconds_)),
      settings_(settings_of(request_, scene())),
      devices_(opened(request_, kept, check_is_due_)),
      kept_(kept),
      check_(first_check()),
      renderer_(made_renderer()),
      goal_(request_.goal()) {
    if (!request_.film_path.empty())
        goal_.keep = {.write = [this](const Film& film) { keep(film); },
                      .seconds = request_.checkpoint.value_or(KeptFilm{}.seconds),
                      .exactly = request_.checkpoint.has_value(),
                      .words = request_.words};
    if (!request_.resume_path.empty()) resume();
    const auto& panel = request_.style.reconstruction.panel;
    if (!panel || request_.pixel) return;
    const DisplaySettings display = display_settings(request_.style, false);
    const CurrentDevice device = [this]() -> Device& { return renderer_->device(); };
    goal_.perceived_noise = [noise = PerceivedNoise(device, panel->panel, panel->ppd, display)](
                                const Film& film) { return noise.of(film); };
    if (goal_.error == 0) {
        goal_.set_errors = perceived_sets(device, *panel, display);
        goal_.where_worth_it = false;  // what that takes was measured of relMSE alone
    }
}

/// What is damaged of the film is rendered again.
void RenderSession::resume() {
    const std::string& path = request_.resume_path;
    SalvagedFilm found = salvage_film(path);
    const Film& film = found.film;
    if (!found.damage().empty())
        warn("Film " + path + ": " + found.damage() + "; " +
             (found.lost.empty() ? "samples are distributed anew." : "they are rendered again."));
    const std::string kernels = film.progress ? film.progress->kernels : "";
    if (!kernels.empty() && kernels != kernel_source::hash())
        warn(
            "Film " + path +
            " was rendered with other kernels than these (of another version of Triad, or by --kernels): its "
            "samples count as they are, but it will not end with the bytes of a render that was never "
            "interrupted.");
    renderer_->resume(film);
    resumed_samples_ = film.sample_numbers().mean, resumed_rays_ = film.counters[COUNTER_RAYS];
    const std::uint64_t begin = !film.ranges.empty() ? film.ranges[0].begin
                                : film.progress      ? film.progress->samples.begin
                                                     : goal_.samples.begin;
    if (film.ranges.size() <= 1 && begin == goal_.samples.begin) return;
    if (!film.is_even() || goal_.adaptive || goal_.error > 0 || goal_.seconds > 0)
        throw Error(Exit::usage, "Film " + path +
                                     " does not hold the first samples, or holds several ranges: only --spp "
                                     "and --samples go on with it, and only where all pixels hold as many.");
    missing_.emplace();
    for (const SampleRange& hole : holes(film, goal_.samples.end))
        if (hole.end > goal_.samples.begin)
            missing_->push_back({std::max(hole.begin, goal_.samples.begin), hole.end});
}

/// Devices that have proved themselves are kept.
std::optional<CheckBeside> RenderSession::first_check() {
    if (check_is_due_) return std::optional<CheckBeside>(std::in_place, device(), request_.kernels_path);
    if (kept_) *kept_ = devices_;
    return {};
}

void RenderSession::prove() {
    if (!check_) return;
    check_->wait();
    check_.reset();
    require_right(devices_->front(), request_.force);
    if (kept_) *kept_ = devices_;
}

/// Does not wait for the check. Where it died without a verdict, it is made anew at once: nothing is kept of
/// the film before.
bool RenderSession::is_proved() {
    if (check_ && check_->has_ended()) prove();
    return !check_;
}

/// That the device is wrong says more than what failed on it, but of one that hangs there is no answer.
template <class Work>
auto RenderSession::unless_device_is_wrong(const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        if (error.exit() == Exit::device && !any_device_hangs()) prove();
        throw;
    }
}

std::unique_ptr<Renderer> RenderSession::made_renderer() {
    return unless_device_is_wrong(
        [&] { return std::make_unique<Renderer>(pointers(*devices_), scene(), settings_); });
}

/// The film as it was stays where it cannot be written, which is no reason to stop. Nothing is written of a
/// device that has not proved itself.
void RenderSession::keep(const Film& film) {
    if (!is_proved()) return;
    try {
        save_film(request_.film_path, film);
    } catch (const std::exception& error) {
        warn(std::string(error.what()) + " The film as it was last written stays, and rendering goes on.");
    }
}

RenderResult RenderSession::fill_holes(const std::function<bool(const Progress&)>& report) {
    RenderResult all;
    for (const SampleRange& hole : *missing_) {
        RenderGoal goal = goal_;
        goal.samples = hole;
        goal.keep.write = nullptr;  // a film may be ahead within its last range alone
        RenderResult result = renderer_->render_until(goal, report);
        result.seconds += all.seconds, result.processor_seconds += all.processor_seconds;
        all = result;
        if (all.stop == Stop::interrupt) break;
        if (goal_.keep.write && hole != missing_->back()) goal_.keep.write(renderer_->film());
    }
    return all;
}

/// Whatever fails of this work, the film that was asked for is written.
template <class Work>
void RenderSession::film_first(const Film& film, const Work& work) {
    try {
        work();
    } catch (...) {
        try {
            if (!request_.film_path.empty()) save_film(request_.film_path, film);
        } catch (const std::exception& error) {
            warn(error.what());
        }
        throw;
    }
}

RenderOutcome RenderSession::render(const std::function<bool(const Progress&)>& report) {
    const auto proving_report = [&](const Progress& progress) {
        is_proved();
        return report(progress);
    };
    RenderOutcome outcome;
    outcome.result = unless_device_is_wrong([&] {
        return missing_ ? fill_holes(proving_report) : renderer_->render_until(goal_, proving_report);
    });
    prove();
    outcome.film = renderer_->take_film();
    film_first(outcome.film, [&] {
        if (request_.style.denoise != Denoiser::off) add_guides(*renderer_, outcome.film);
    });
    outcome.rays = outcome.film.counters[COUNTER_RAYS] - resumed_rays_;
    outcome.numbers = outcome.film.sample_numbers();
    outcome.relmse = estimated_relmse(outcome.film);
    return outcome;
}

void RenderSession::write(const RenderOutcome& outcome) {
    const Span span("write", "write");
    film_first(outcome.film, [&] {
        write_outputs(request_.outputs, renderer_->device(), outcome.film, request_.style, layers_of(outcome),
                      metadata_of(outcome));
    });
    // The film last: where it says that it is complete, the pictures are there.
    if (!request_.film_path.empty()) save_film(request_.film_path, outcome.film);
}

}  // namespace triad
