#include "session/prepare.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/check_outputs.h"
#include "base/log.h"
#include "base/spans.h"
#include "check/check_beside.h"
#include "check/verdict.h"
#include "scene/builtin_scene.h"
#include "scene/strokes.h"
#include "session/choose_view.h"
#include "trace/path_driver.h"
#include "trace/tune.h"

namespace triad {

namespace {

std::string material_names(const Scene& scene) {
    std::string names;
    for (const Material& m : scene.materials)
        if (!m.name.empty()) names += (names.empty() ? "'" : ", '") + m.name + "'";
    return names.empty() ? "none has a name" : "there are " + names;
}

}  // namespace

void apply_glass(Scene& scene, const std::string& text) {
    const std::size_t split = text.rfind('=');
    if (split == std::string::npos || split == 0 || split + 1 == text.size())
        throw Error(Exit::usage, "--glass " + text + ": expected MATERIAL=NAME.");
    const std::string material = text.substr(0, split), name = text.substr(split + 1);
    const std::optional<Dispersion> glass = find_glass(name);
    if (!glass)
        throw Error(Exit::usage, "--glass " + text + ": there is no glass '" + name + "'; there are " +
                                     glass_names() + ".");
    bool found = false;
    for (Material& m : scene.materials) {
        if (m.name != material) continue;
        found = true;
        if (!(m.transmission > 0.0f && m.thickness > 0.0f))
            throw Error(Exit::usage,
                        "--glass " + text +
                            ": the material is no solid body that transmits "
                            "(KHR_materials_transmission and KHR_materials_volume with a thickness "
                            "above 0).");
        m.dispersion = glass;
        m.ior = static_cast<float>(glass->index(line_d));
    }
    if (!found)
        throw Error(Exit::usage, "--glass " + text + ": no material that is drawn has that name; " +
                                     material_names(scene) + ".");
}

namespace {

/// --look and --ground, or what a scene gets that brings no light.
void light_as_asked(const RenderRequest& o, Scene& scene) {
    const bool dark = !has_light(scene);
    if (o.look && scene.environment)
        throw Error(Exit::usage,
                    std::string("--look ") + name_of(*o.look) +
                        ": the scene brings an environment of its own, and there is one at a time.");
    if (o.look || dark) light(scene, o.look.value_or(Look::studio));
    if (dark && !o.look)
        inform(
            "The scene has no light: it stands in a soft studio (--look sky or white, or --env FILE, light "
            "it "
            "otherwise).");
    if (!o.ground.value_or(dark && scene.cameras.empty() && !o.transparent)) return;
    stand_on_ground(scene);
    validate(scene);
}

}  // namespace

LoadedScene read_scene(const RenderRequest& o) {
    if (o.scene_path.empty()) {
        if (!o.variant.empty() || !o.animation.empty() || o.pose_time != 0)
            throw Error(Exit::usage,
                        "The built-in scene has no variants and no animations: --variant, --animation and "
                        "--pose-time go with a file.");
        return {builtin_scene(), {}};
    }
    LoadedScene loaded;
    loaded.scene = load_gltf(o.scene_path,
                             {.scene = o.scene_index,
                              .variant = o.variant,
                              .animation = o.animation,
                              .time = o.pose_time,
                              .strict = o.strict,
                              .max_texture = o.max_texture,
                              .image_light = o.env_path.empty()},
                             &loaded.report);
    refuse_to_replace(o.outputs_named(), loaded.report.files);
    for (const std::string& warning : loaded.report.warnings) warn(warning);
    return loaded;
}

void prepare_scene(const RenderRequest& o, Scene& scene) {
    for (const std::string& text : o.glass) apply_glass(scene, text);
    if (!o.env_path.empty()) scene.environment = load_environment(o.env_path, o.strict);
    if (const std::size_t dropped = validate(scene))
        detail(std::to_string(dropped) + " triangles have no area or no finite corners and are left out");
    if (has_strokes(scene)) {
        const RenderSettings settings = settings_of(o, scene);
        draw_strokes(scene, settings.view, settings.height, o.point_size);
        validate(scene);
    }
    light_as_asked(o, scene);
    if (o.env_rotate != 0 && !scene.environment)
        throw Error(
            Exit::usage,
            "--env-rotate: the scene has no environment to turn. --env FILE and --look sky bring one.");
}

Scene load_scene(const RenderRequest& o) {
    Scene scene = read_scene(o).scene;
    prepare_scene(o, scene);
    return scene;
}

RenderSettings settings_of(const RenderRequest& o, const Scene& scene) {
    const SceneCamera* camera = o.look_at || o.orbit ? nullptr : choose_camera(scene, o.camera);
    const uvec2 size = choose_size(o, camera);
    RenderSettings settings;
    settings.width = size.x, settings.height = size.y;
    if (o.crop) settings.crop = *o.crop;
    if (o.pixel) {
        if ((*o.pixel)[0] >= size.x || (*o.pixel)[1] >= size.y)
            throw Error(Exit::usage, "--pixel " + std::to_string((*o.pixel)[0]) + "," +
                                         std::to_string((*o.pixel)[1]) + " is not in the picture of " +
                                         std::to_string(size.x) + " x " + std::to_string(size.y) +
                                         " pixels.");
        settings.crop = {(*o.pixel)[0], (*o.pixel)[1], 1, 1};
    }
    apply(o.style.reconstruction, settings);
    settings.seed = o.seed;
    settings.max_depth = o.max_depth;
    settings.roulette = o.roulette;
    settings.independent = o.independent;
    settings.texture_levels = o.texture_levels;
    settings.spectral = o.spectral;
    settings.integrator = o.integrator;
    settings.photons = o.photons;
    settings.aim_photons = o.aim_photons;
    settings.final_gather = o.final_gather;
    settings.photon_radius = o.photon_radius;
    settings.transparent = o.transparent;
    settings.view = choose_view(o, scene, camera, size);
    settings.environment_rotation = o.env_rotate * pi / 180;
    settings.environment_strength = o.env_strength;
    check_limits(settings, scene);
    return settings;
}

namespace {

Device opened(const RenderRequest& o, Device::Settings settings, bool* check_is_due = nullptr) {
    const Span span("open the device", "device");
    settings.profile = o.profile;
    Device device = Device::open(settings);
    Tuning wishes;
    if (o.format) wishes["format"] = name_of(*o.format);
    if (o.path_driver) wishes["path_driver"] = name_of(*o.path_driver);
    const Tuning tuning = ensure_tuned(device, wishes);
    const bool due = check_is_due && CheckBeside::is_due(device);
    if (check_is_due) *check_is_due = due;
    if (!due) require_right(device, o.force);
    detail("Device: " + device.info().name + ", driver " + device.info().driver + ", " + text_of(tuning));
    return device;
}

/// Of what was measured when the device was first used, which is the same work on every device.
double tuned_seconds(Device& device) {
    ensure_tuned(device);
    double best = INFINITY;
    for (const TuneTiming& timing : load_timings(device.info()).value_or(std::vector<TuneTiming>{}))
        if (timing.search == tune_searches().front().name) best = std::min(best, timing.seconds);
    return best;
}

/// Every piece of hardware once, by its fastest driver.
std::vector<Device::Settings> all_devices(unsigned threads) {
    const std::vector<DeviceInfo> devices = list_devices().devices;
    std::vector<Device::Settings> chosen;
    for (const std::vector<std::size_t>& drivers : hardware_of(devices)) {
        std::size_t best = drivers.front();
        double least = INFINITY;
        for (const std::size_t i : drivers) {
            if (drivers.size() == 1) break;
            try {
                Device device =
                    Device::open({.selector = std::to_string(devices[i].index), .threads = threads});
                const double seconds = tuned_seconds(device);
                if (seconds < least) best = i, least = seconds;
            } catch (const Error& error) {
                warn(std::string(error.what()) + " It is left out.");
            }
        }
        chosen.push_back({.selector = std::to_string(devices[best].index), .threads = threads});
    }
    return chosen;
}

/// SEL or SEL/N.
std::vector<Device::Settings> parts_of(const std::string& text, unsigned threads) {
    const std::size_t slash = text.rfind('/');
    const std::string number = slash == std::string::npos ? "" : text.substr(slash + 1);
    if (number.empty() || number.size() > 4 || number.find_first_not_of("0123456789") != std::string::npos)
        return {{.selector = text, .threads = threads}};
    const unsigned parts = unsigned(std::stoul(number));
    if (parts == 0) throw Error(Exit::usage, "--device " + text + ": a device has at least one part.");
    std::vector<Device::Settings> settings;
    for (unsigned part = 0; part < parts; ++part)
        settings.push_back(
            {.selector = text.substr(0, slash), .threads = threads, .part = part, .parts = parts});
    return settings;
}

std::vector<Device::Settings> named_devices(const std::string& text, unsigned threads) {
    if (text == "all") return all_devices(threads);
    std::vector<Device::Settings> settings;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');)
        for (const Device::Settings& each : parts_of(word, threads)) settings.push_back(each);
    if (settings.empty()) settings.push_back({.threads = threads});
    return settings;
}

}  // namespace

Device open_device(const RenderRequest& o) { return opened(o, {.selector = o.device, .threads = o.threads}); }

std::vector<std::vector<std::size_t>> hardware_of(const std::vector<DeviceInfo>& devices) {
    std::map<std::string, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (devices[i].usable) groups[devices[i].hardware].push_back(i);
    std::vector<std::vector<std::size_t>> hardware;
    for (auto& [name, drivers] : groups) hardware.push_back(std::move(drivers));
    return hardware;
}

std::vector<Device> open_devices(const RenderRequest& o, bool* check_is_due) {
    const std::vector<Device::Settings> wanted = named_devices(o.device, o.threads);
    if (wanted.size() > 1 || wanted.front().parts > 1) check_is_due = nullptr;
    std::vector<Device> devices;
    std::exception_ptr failed;
    std::set<std::size_t> named;
    std::string twice;
    for (const Device::Settings& settings : wanted) {
        try {
            devices.push_back(opened(o, settings, check_is_due));
            const DeviceInfo& info = devices.back().info();
            if (settings.part == 0 && !named.insert(info.index).second) twice = info.name;
        } catch (const Error& error) {
            if (wanted.size() == 1 || error.exit() == Exit::usage) throw;
            failed = std::current_exception();
            warn(std::string(error.what()) + " It is left out.");
        }
    }
    if (!twice.empty())
        warn("--device " + o.device + " names " + twice +
             " more than once: it shares the picture with itself.");
    if (devices.empty()) {
        if (failed) std::rethrow_exception(failed);
        throw Error(Exit::device, "There is no usable OpenCL device (triad devices says why).");
    }
    return devices;
}

}  // namespace triad
