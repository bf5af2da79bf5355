#include "trace/tune_paths.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "scene/shapes.h"
#include "trace/node_format.h"
#include "trace/tracer.h"

namespace triad {
namespace {

using Clock = std::chrono::steady_clock;

struct Size {
    unsigned width, height;
    std::size_t tiles() const { return std::size_t(width) * height / FILM_TILE_PIXELS; }
};
/// Of the pictures: a CPU's has all tiles in one launch, as renders launch them; a GPU has little to do in
/// one so small.
constexpr Size small_picture{256, 248}, large_picture{1024, 992};
static_assert(std::size_t(small_picture.width) * small_picture.height <= largest_launch_items);
/// Long enough for the last paths of a launch, which leave lanes and pools empty, to weigh as in renders.
constexpr double launch_seconds = 0.03;
constexpr std::uint32_t most_samples_per_launch = 256;

void place(Scene& scene, Primitive shape, const Material& material) {
    shape.material = scene.materials.size();
    scene.materials.push_back(material);
    scene.meshes.push_back({"mesh", {std::move(shape)}});
    scene.instances.push_back({"node", scene.meshes.size() - 1, dmat4(1.0)});
}

/// A lit room with a body of many triangles, one of metal, and one that is plastic or dispersing glass.
Scene room(bool disperses) {
    Material wall, metal, light, body;
    wall.base_colour = vec4(0.7f, 0.7f, 0.7f, 1.0f), wall.metallic = 0.0f;
    metal.base_colour = vec4(0.9f, 0.7f, 0.4f, 1.0f), metal.roughness = 0.3f;
    light.base_colour = vec4(0.0f, 0.0f, 0.0f, 1.0f), light.metallic = 0.0f, light.emission = vec3(15.0f);
    body.metallic = 0.0f, body.roughness = 0.2f;
    if (disperses) {
        body.roughness = 0.0f, body.transmission = 1.0f, body.thickness = 1.0f;
        body.ior = 1.6f, body.dispersion = abbe_dispersion(1.6, 20.0 / 40.0);
    }
    Scene scene;
    place(scene, shapes::box(vec3(-1.0f, 0.0f, -1.0f), vec3(1.0f, 2.0f, 1.0f), true), wall);
    place(scene, shapes::quad({-0.3f, 1.99f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}), light);
    place(scene, shapes::displaced_sphere(vec3(-0.45f, 0.45f, -0.3f), 0.4f, 96, 48, 0.2f, 5.0f, 1), wall);
    place(scene, shapes::lat_long_sphere(vec3(0.5f, 0.35f, -0.4f), 0.35f, 48, 24), metal);
    place(scene, shapes::lat_long_sphere(vec3(0.1f, 0.3f, 0.4f), 0.28f, 48, 24), body);
    return scene;
}

/// Samples of a room, by whatever the device follows paths with.
class Room {
  public:
    Room(Device& device, bool disperses)
        : size_(device.info().type == "cpu" ? small_picture : large_picture), all_tiles_(size_.tiles()) {
        settings_.width = size_.width, settings_.height = size_.height;
        settings_.view = look_at({0.0, 1.0, 0.95}, {0.0, 0.8, 0.0}, 1.3, double(size_.width) / size_.height);
        Scene scene = room(disperses);
        validate(scene);
        scene_ = std::make_shared<DeviceScene>(device, pack_for(scene, settings_, {}, {format_of(device)}));
        shape_.full_width = shape_.width = size_.width, shape_.full_height = shape_.height = size_.height;
        shape_.quanta_log2 = scene_->packed().quanta_log2;
        const auto tracer = make_tracer();
        time(*tracer);  // warms up
        while (tiles_ < all_tiles_ && time(*tracer) < launch_seconds)
            tiles_ = std::min(2 * tiles_, all_tiles_);
        while (tiles_ == all_tiles_ && samples_ < most_samples_per_launch && time(*tracer) < launch_seconds)
            samples_ *= 2;
    }

    double seconds() {
        const auto tracer = make_tracer();
        double best = std::numeric_limits<double>::infinity();
        for (int launch = 0; launch < 4; ++launch) best = std::min(best, time(*tracer));
        return best;
    }

  private:
    Size size_;
    std::size_t all_tiles_;
    RenderSettings settings_;
    std::shared_ptr<const DeviceScene> scene_;
    Film shape_;
    std::size_t tiles_ = 16;
    std::uint32_t samples_ = 1;

    std::unique_ptr<Tracer> make_tracer() const {
        return std::make_unique<Tracer>(scene_, settings_, features_of(scene_->packed(), settings_), shape_);
    }

    double time(Tracer& tracer) const {
        std::vector<dev::TileWork> work;
        for (std::size_t i = 0; i < tiles_; ++i)  // from the whole picture, also where they are few
            work.push_back({std::uint32_t(i * all_tiles_ / tiles_), {0, 0}, {samples_, samples_}, {}});
        tracer.set_work(work);
        tracer.finish();
        const auto start = Clock::now();
        tracer.trace(0, work.size(), 0);
        tracer.finish();
        return std::chrono::duration<double>(Clock::now() - start).count();
    }
};

class PathWorkload : public Workload {
  public:
    explicit PathWorkload(Device& device) : plain_(device, false), dispersing_(device, true) {}

    /// The geometric mean, so that neither room weighs more for being slower.
    double seconds() override { return std::sqrt(plain_.seconds() * dispersing_.seconds()); }

  private:
    Room plain_, dispersing_;
};

}  // namespace

std::unique_ptr<Workload> make_path_workload(Device& device) {
    return std::make_unique<PathWorkload>(device);
}

}  // namespace triad
