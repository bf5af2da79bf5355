#include "trace/tune_rays.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>

#include "scene/shapes.h"
#include "trace/node_format.h"

namespace triad {
namespace {

/// Long walks that differ from item to item.
std::vector<dev::Ray> tuning_rays(std::size_t count) {
    std::mt19937 random(1);
    const auto uniform = [&] { return float(random() >> 8) * 0x1p-23f - 1.0f; };
    std::vector<dev::Ray> rays(count);
    for (dev::Ray& ray : rays) {
        for (int a = 0; a < 3; ++a) ray.origin[a] = 0.4f * uniform(), ray.direction[a] = uniform();
        ray.t_max = std::numeric_limits<float>::infinity();
        ray.skip_instance = ray.skip_primitive = TRIAD_NONE;
    }
    return rays;
}

class RayWorkload : public Workload {
  public:
    explicit RayWorkload(Device& device) : device_(device) {
        const Primitive shape = shapes::displaced_sphere(vec3(0.0f), 1.0f, 128, 64, 0.3f, 6.0f, 1);
        std::vector<BvhTriangle> triangles;
        for (const uvec3& t : shape.triangles)
            triangles.push_back({{shape.positions[t.x], shape.positions[t.y], shape.positions[t.z]},
                                 std::uint32_t(triangles.size())});
        roots_ = build_bvh(triangles, {}, 1.0f, pool_);
        blocks_ = device.upload(pool_.blocks);
        // As many rays as keep the device busy for some 20 ms; few at first, since on a processor without
        // vectors for OpenCL (llvmpipe's) thousands take minutes.
        for (count_ = 1u << 8; count_ < (1u << 22) && measure() < 0.01;) count_ *= 2;
    }

    double seconds() override { return measure(); }

  private:
    double measure() {
        if (rays_.bytes() != count_ * sizeof(dev::Ray)) {
            rays_ = device_.upload(tuning_rays(count_));
            hits_ = device_.allocate(count_ * sizeof(dev::Hit));
        }
        const Kernel kernel =
            device_.build("traversal/intersect.cl", {{"TRIAD_INSTANCES", "0"}}).kernel("intersect_closest");
        const Arguments arguments = Arguments()
                                        .add(nodes_on(device_, pool_))
                                        .add(blocks_)
                                        .add(Buffer{})
                                        .add(roots_[std::size_t(format_of(device_))])
                                        .add(rays_)
                                        .add(hits_)
                                        .add(std::uint32_t(count_));
        double best = std::numeric_limits<double>::infinity();
        double spent = 0;
        for (int launch = 0; launch < 4 && spent < 1; ++launch) {  // the first compiles and is never the best
            device_.finish();
            const auto start = std::chrono::steady_clock::now();
            device_.run(kernel, arguments, count_);
            device_.finish();
            const double took =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            best = std::min(best, took);
            if (launch > 0) spent += took;
        }
        return best;
    }

    Device& device_;
    BvhPool pool_;
    BvhRoots roots_{};
    DeviceArray<dev::TriangleBlock> blocks_;
    Buffer rays_, hits_;
    std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<Workload> make_ray_workload(Device& device) { return std::make_unique<RayWorkload>(device); }

}  // namespace triad
