#include "profile/kernel_costs.h"

#include "kernels/types.h"

namespace triad {
namespace {

/// Of a ray and a box: six fused multiply-adds (kernels/traversal/slab.h), and as many minima and maxima.
constexpr double box_flops = 18;
/// Of a ray and a triangle (kernels/traversal/edges.h): 21 that move and shear three corners, 18 of three
/// edge functions, 2 of their sum, 14 of the distance and the weights.
constexpr double triangle_flops = 55;

struct Format {
    double node_bytes, boxes, triangle_bytes;
};

Format shape_of(BvhFormat format) {
    constexpr double block = sizeof(dev::TriangleBlock) / 4.0;
    return format == BvhFormat::bvh4 ? Format{sizeof(dev::Bvh4Node), 4, block}
                                     : Format{sizeof(dev::Bvh8Node), 8, block};
}

struct Work {
    double bytes = 0, flops = 0, gathers = 0;
    Work operator+(const Work& o) const { return {bytes + o.bytes, flops + o.flops, gathers + o.gathers}; }
    Work operator*(double n) const { return {bytes * n, flops * n, gathers * n}; }
};

Work walks(const RayCounts& rays, const Format& format) {
    return {double(rays.nodes) * format.node_bytes + double(rays.triangles) * format.triangle_bytes,
            double(rays.nodes) * format.boxes * box_flops + double(rays.triangles) * triangle_flops,
            double(rays.nodes + rays.blocks)};
}

/// What a surface is read from: its triangle, corners' normals and texture coordinates, and material.
constexpr Work surface{
    sizeof(dev::Triangle) + sizeof(dev::Geometry) + sizeof(dev::Material) + 3 * (3 + 2) * sizeof(float), 0,
    3};
/// And where a sample goes.
constexpr Work film{2.0 * (FILM_CHANNELS + 3) * sizeof(std::int64_t), 0, 0};

constexpr Work planes(double count) { return {count * sizeof(std::uint32_t), 0, 0}; }

}  // namespace

std::optional<KernelCost> cost_of(const std::string& kernel, const WorkCounts& counts, BvhFormat format,
                                  double samples) {
    const double counted = double(counts.width) * counts.height * counts.samples;
    if (!(counted > 0)) return {};
    const double scale = samples / counted, vertices = double(counts.vertices()) * scale;
    const Format shape = shape_of(format);
    const Work shadow = walks(counts.rays[WORK_SHADOW], shape) * scale,
               edges =
                   (walks(counts.rays[WORK_CAMERA], shape) + walks(counts.rays[WORK_BOUNCE], shape)) * scale;
    const double edge_rays = double(counts.rays[WORK_CAMERA].rays + counts.rays[WORK_BOUNCE].rays) * scale,
                 shadow_rays = double(counts.rays[WORK_SHADOW].rays) * scale;
    constexpr double path = POOL_PATH_PLANES, hit = POOL_HIT_PLANES, light = POOL_LIGHT_PLANES;
    const auto cost = [](const char* unit, double units, const Work& work, bool is_whole = false) {
        return KernelCost{unit, units, work.bytes, work.flops, work.gathers, is_whole};
    };
    const Work shading = surface * vertices;
    if (kernel == "trace_paths" || kernel == "count_work")
        return cost("sample", samples, edges + shadow + shading + film * samples);
    if (kernel == "trace_wave")
        return cost("sample", samples,
                    edges + shadow + shading + film * samples + planes(2 * path + hit) * edge_rays +
                        planes(hit + light) * vertices);
    if (kernel == "wave_intersect_edges")
        return cost("ray", edge_rays, edges + planes(path + hit) * edge_rays, true);
    if (kernel == "wave_intersect_lights")
        return cost("ray", shadow_rays, shadow + planes(light) * shadow_rays, true);
    if (kernel == "wave_meet_surfaces" || kernel == "wave_scatter_paths")
        return cost("vertex", vertices, shading + planes(1.5 * path + hit) * vertices);
    if (kernel == "wave_connect_paths" || kernel == "wave_gather_photons")
        return cost("vertex", vertices, shading + planes(path + hit + light) * vertices);
    if (kernel == "wave_average_films")
        return cost("vertex", vertices, shading + planes(path + hit) * vertices);
    if (kernel == "wave_start_paths") return cost("sample", samples, planes(path) * samples);
    if (kernel == "wave_end_paths") return cost("sample", samples, planes(path) * samples + film * samples);
    return {};
}

}  // namespace triad
