// A scene is loaded, its trees are built, and 4 x 4 pixels of it are rendered on the CPU: by the program with
// everything compiled in, since compiling one for each scene takes longest.
#include <cstdlib>

#include "device/device.h"
#include "fuzz/targets/target.h"
#include "render/renderer.h"
#include "session/prepare.h"
#include "trace/node_format.h"

using namespace triad;

TRIAD_FUZZ_TARGET(render) {
    static Device* const device = [] {
        auto* const opened = new Device(Device::open({.selector = "cpu"}));
        set_format(*opened, default_format(opened->info()));
        return opened;
    }();
    RenderRequest request;
    request.scene_path = fuzz::file_of(input).string();
    request.size = uvec2(4);
    request.integrator = Integrator::path;
    const Scene scene = load_scene(request);
    Renderer renderer(*device, scene, settings_of(request, scene), Features{});
    renderer.render({0, 2}, [](const Progress&) { return true; });
    if (renderer.film().sums.size() != 4 * 4 * 4) std::abort();
}
