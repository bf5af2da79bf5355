/// What a ViewLoop shows and tells the page.
#include <algorithm>
#include <charconv>
#include <exception>

#include "base/error.h"
#include "base/text.h"
#include "session/metadata.h"
#include "viewer/view_loop.h"

namespace triad {
namespace {

constexpr double least_interval = 0.25, most_interval = 3, share_of_age = 0.1, times_its_cost = 8;

/// The shortest that is read as the same.
std::string number(double x) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

void ViewLoop::show(const Film& film, Shown what) {
    const auto start = Clock::now();
    const bool is_preview = what == Shown::preview;
    request_.style = exposed(request_.style, film);  // once: a picture that grows keeps its light
    facts_.exposure = request_.style.exposure;
    OutputStyle style = request_.style;
    if (is_preview) style.reconstruction = {};
    ViewFrame frame;
    frame.columns = film.width, frame.rows = film.height;
    frame.rgba = encode_srgb(display_of(scene_->device(), film, style), 4, 8);
    for (std::size_t p = 0; p < film.pixels(); ++p)
        if (film.samples[p] == 0) frame.rgba[4 * p + 3] = 0, frame.partial = true;
    const uvec2 whole = size();
    frame.full_width = whole.x, frame.full_height = whole.y;
    frame.x = film.x, frame.y = film.y;
    frame.width = is_preview ? whole.x : film.width, frame.height = is_preview ? whole.y : film.height;
    frame.panel = panel_;
    const bool of_region = what == Shown::region;
    (of_region ? facts_.region_frame : facts_.frame) = exchange_.show(std::move(frame), of_region);
    facts_.divisor = is_preview ? divisor_ : 1;
    facts_.width = whole.x, facts_.height = whole.y;
    if (const auto seconds = exchange_.seconds_since_move()) facts_.move_seconds = seconds;
    note_kernels();
    tell();
    const std::chrono::duration<double> cost = Clock::now() - start;
    if (!is_preview) show_seconds_ = cost.count();
    next_show_ = show_time(cost.count());
}

/// Of the next picture: later ones change less, and none takes much of the time.
ViewLoop::Clock::time_point ViewLoop::show_time(double cost) const {
    const std::chrono::duration<double> age = Clock::now() - began_;
    const double interval = std::max(std::clamp(share_of_age * age.count(), least_interval, most_interval),
                                     times_its_cost * cost);
    return Clock::now() + std::chrono::microseconds(std::int64_t(1e6 * interval));
}

/// What is around the region, as it was last rendered.
void ViewLoop::show_around() {
    if (region_[2] == 0) return;
    if (whole_.film)
        show(*whole_.film, Shown::whole);
    else if (preview_)
        show(*preview_, Shown::preview);
}

/// The samples that there are, with another exposure or tone map.
void ViewLoop::show_again() {
    restyle_ = false;
    show_around();
    if (current().film)
        show(*current().film, region_[2] > 0 ? Shown::region : Shown::whole);
    else if (preview_ && region_[2] == 0)
        show(*preview_, Shown::preview);
}

void ViewLoop::serve(const Film& film) {
    for (ViewFile& file : exchange_.take_files()) {
        try {
            if (file.extension == ".triadfilm") {
                file.bytes.set_value(encode_film(film));
                continue;
            }
            Metadata metadata = metadata_of(film);
            describe(request_.style.reconstruction, metadata);
            file.bytes.set_value(
                text_of(encode_output(file.extension, scene_->device(), film, request_.style, metadata)));
        } catch (const std::exception&) {  // memory, too
            file.bytes.set_exception(std::current_exception());
        }
    }
}

void ViewLoop::serve_or_refuse() {
    if (current().film) return serve(*current().film);
    for (ViewFile& file : exchange_.take_files())
        file.bytes.set_exception(
            std::make_exception_ptr(Error(Exit::usage, "There is no picture to save yet: let it render.")));
}

void ViewLoop::note_kernels() {
    for (Device& device : scene_->devices())
        for (const DeviceCommand& command : device.take_commands()) {
            KernelTime& time = facts_.kernels[command.name];
            ++time.launches, time.seconds += 1e-9 * double(command.end - command.start);
        }
}

void ViewLoop::tell() {
    facts_.command = scene_ && !(camera_.is_moved && camera_.view.orthographic)
                         ? command_(options(), keeps_display())
                         : std::string();
    exchange_.tell(json_of(facts_));
}

/// Nothing was chosen of panels, or what was asked for at first.
bool ViewLoop::keeps_display() const {
    return facts_.panel == first_.reconstruct.panel && (facts_.panel.empty() || facts_.subpixels);
}

/// That say the picture as it is now.
std::vector<std::string> ViewLoop::options() const {
    std::vector<std::string> words;
    const auto add = [&](const std::string& name, const std::string& value) {
        words.push_back("--" + name + "=" + value);
    };
    if (camera_.is_moved) {
        const dvec3 &eye = camera_.view.eye, &target = camera_.target;
        add("look-at", number(eye.x) + "," + number(eye.y) + "," + number(eye.z) + "," + number(target.x) +
                           "," + number(target.y) + "," + number(target.z));
        add("fov", number(camera_.fov));
    } else if (facts_.camera >= 0) {
        add("camera", std::to_string(facts_.camera));
    } else {
        if (!first_.camera.empty()) add("camera", first_.camera);
        if (first_.look_at) {
            std::string values;
            for (const double x : *first_.look_at) values += (values.empty() ? "" : ",") + number(x);
            add("look-at", values);
        }
        if (first_.orbit) {
            const auto [azimuth, elevation, zoom] = *first_.orbit;
            add("orbit", number(azimuth) + "," + number(elevation) + "," + number(zoom));
        }
        if (first_.fov) add("fov", number(*first_.fov));
    }
    const uvec2 whole = size();
    add("size", std::to_string(whole.x) + "x" + std::to_string(whole.y));
    if (region_[2]) add("crop", format("%u,%u,%u,%u", region_[0], region_[1], region_[2], region_[3]));
    if (!request_.variant.empty()) add("variant", request_.variant);
    if (request_.style.exposure != 0) add("exposure", format("%g", request_.style.exposure));
    if (request_.style.tone_map != OutputStyle().tone_map) add("tonemap", request_.style.tone_map);
    if (keeps_display() || facts_.panel.empty()) return words;
    if (facts_.subpixels)
        add("panel", facts_.panel);
    else
        add("bins", "3x3");
    return words;
}

}  // namespace triad
