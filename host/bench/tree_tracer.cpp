#include "bench/tree_tracer.h"

#include <chrono>
#include <memory>
#include <span>

#include "trace/node_format.h"

namespace triad {

TreeTracer::TreeTracer(Device& device, const RayScene& scene) : device_(device) {
    std::vector<BvhTriangle> triangles;
    for (const uvec3& t : scene.mesh.triangles)
        triangles.push_back(
            {{scene.mesh.positions[t.x], scene.mesh.positions[t.y], scene.mesh.positions[t.z]},
             std::uint32_t(triangles.size()),
             true});
    const auto pool = std::make_shared<BvhPool>();
    const auto start = std::chrono::steady_clock::now();
    pool->formats = {format_of(device)};
    root_ = build_bvh(triangles, {}, scene.reach, *pool)[std::size_t(format_of(device))];
    build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    nodes_ = nodes_on(device_, *pool, pool);
    blocks_ = device_.share(std::span<const dev::TriangleBlock>(pool->blocks), pool);
    const Program program = device_.build("traversal/intersect.cl", {{"TRIAD_INSTANCES", "0"}});
    closest_ = program.kernel("intersect_closest");
    occluded_ = program.kernel("intersect_occluded");
    if (triad::walks_packets(device)) packets_ = program.kernel("intersect_packets");
}

void TreeTracer::set_rays(const std::vector<dev::Ray>& rays) {
    count_ = std::uint32_t(rays.size());
    rays_ = device_.upload(rays);
    results_ = device_.allocate(rays.size() * sizeof(dev::Hit));
}

void TreeTracer::trace(bool occluded) { run(occluded ? occluded_ : closest_, count_); }

void TreeTracer::trace_packets() { run(packets_.value(), (count_ + PACKET_RAYS - 1) / PACKET_RAYS); }

void TreeTracer::run(const Kernel& kernel, std::size_t items) {
    const Arguments arguments =
        Arguments().add(nodes_).add(blocks_).add(Buffer{}).add(root_).add(rays_).add(results_).add(count_);
    device_.run(kernel, arguments, items);
    device_.finish();
}

std::vector<std::uint32_t> TreeTracer::occluded() {
    std::vector<std::uint32_t> values(count_);
    device_.read(results_, values.data(), values.size() * sizeof(std::uint32_t));
    return values;
}

}  // namespace triad
