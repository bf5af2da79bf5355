#include "trace/tune.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "bvh/bvh.h"
#include "scene/shapes.h"
#include "trace/node_format.h"

namespace triad {
namespace {

constexpr std::size_t default_local = 64;

/// Incoherent rays inside a bumpy sphere: long walks that differ from item to item.
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

}  // namespace

std::vector<LocalTiming> time_locals(Device& device) {
    const Primitive shape = shapes::displaced_sphere(vec3(0.0f), 1.0f, 128, 64, 0.3f, 6.0f, 1);
    std::vector<BvhTriangle> triangles;
    for (const uvec3& t : shape.triangles)
        triangles.push_back({{shape.positions[t.x], shape.positions[t.y], shape.positions[t.z]},
                             std::uint32_t(triangles.size())});
    BvhPool pool;
    pool.formats = {format_of(device)};
    const std::uint32_t root = build_bvh(triangles, {}, 1.0f, pool)[std::size_t(format_of(device))];
    const Buffer nodes = nodes_on(device, pool), blocks = device.upload(pool.blocks);
    const Kernel kernel =
        device.build("traversal/intersect.cl", {{"TRIAD_INSTANCES", "0"}}).kernel("intersect_closest");

    const auto seconds = [&](std::size_t count, std::size_t local) {
        const Buffer rays = device.upload(tuning_rays(count)),
                     hits = device.allocate(count * sizeof(dev::Hit));
        const Arguments arguments =
            Arguments().add(nodes).add(blocks).add(Buffer{}).add(root).add(rays).add(hits).add(
                std::uint32_t(count));
        double best = std::numeric_limits<double>::infinity();
        for (int launch = 0; launch < 4; ++launch) {  // the first compiles and is never the best
            device.finish();
            const auto start = std::chrono::steady_clock::now();
            device.run(kernel, arguments, count, local);
            device.finish();
            best = std::min(best,
                            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
        return best;
    };
    // As many rays as keep the device busy for some 20 ms.
    std::size_t count = 1u << 14;
    while (count < (1u << 22) && seconds(count, default_local) < 0.01) count *= 2;

    std::vector<LocalTiming> timings;
    for (const std::size_t local : {std::size_t(1), std::size_t(8), default_local})
        if (local <= std::max<std::size_t>(1, device.info().max_work_group))
            timings.push_back({local, seconds(count, local)});
    return timings;
}

std::size_t tune_local(Device& device) {
    const std::vector<LocalTiming> timings = time_locals(device);
    LocalTiming best = timings.back();  // the largest, if nothing is clearly faster
    const double limit = 0.95 * best.seconds;
    for (const LocalTiming& timing : timings)
        if (timing.seconds < limit && timing.seconds < best.seconds) best = timing;
    device.set_preferred_local(best.local);
    store_tuned_local(device.info(), best.local);
    return best.local;
}

std::size_t ensure_tuned(Device& device) {
    const auto kept = load_tuned_local(device.info());
    if (!kept) return tune_local(device);
    device.set_preferred_local(*kept);
    return *kept;
}

}  // namespace triad
