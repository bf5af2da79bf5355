#include "session/prepare.h"

#include "base/log.h"
#include "check/verdict.h"
#include "scene/builtin_scene.h"
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

Scene load_scene(const RenderRequest& o) {
    Scene scene;
    if (o.scene_path.empty()) {
        scene = builtin_scene();
    } else {
        GltfReport report;
        scene = load_gltf(o.scene_path, {o.scene_index}, &report);
        for (const std::string& warning : report.warnings) warn(warning);
    }
    for (const std::string& text : o.glass) apply_glass(scene, text);
    if (!o.env_path.empty()) scene.environment = load_environment(o.env_path);
    if (const std::size_t dropped = validate(scene))
        detail(std::to_string(dropped) + " triangles have no area or no finite corners and are left out");
    if (!has_light(scene)) {
        scene.sky = vec3(1.0f);
        inform("The scene has no light: it gets a plain white sky (--env FILE lights it with a panorama).");
    }
    return scene;
}

RenderSettings settings_of(const RenderRequest& o, const Scene& scene) {
    const SceneCamera* camera = o.look_at ? nullptr : choose_camera(scene, o.camera);
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

Device open_device(const RenderRequest& o) {
    Device device = Device::open({.selector = o.device, .threads = o.threads});
    Tuning wishes;
    if (o.format) wishes["format"] = name_of(*o.format);
    if (o.path_driver) wishes["path_driver"] = name_of(*o.path_driver);
    const Tuning tuning = ensure_tuned(device, wishes);
    require_right(ensure_checked(device), device.info(), o.force);
    detail("Device: " + device.info().name + ", driver " + device.info().driver + ", " + text_of(tuning));
    return device;
}

}  // namespace triad
