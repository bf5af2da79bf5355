#include "tinybvh_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/files.h"

#if TRIAD_TINYBVH
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#define TINYBVH_IMPLEMENTATION
#include <tiny_bvh.h>
#pragma GCC diagnostic pop
#endif

namespace triad::bench {

const std::vector<std::string>& TinybvhTracer::layouts() {
    static const std::vector<std::string> names{"cwbvh", "gpu4way"};
    return names;
}

#if TRIAD_TINYBVH

namespace {

/// As tinybvh's kernels read it.
struct BatchRay {
    float origin[4], direction[4], reciprocal[4];
    float hit[4];
};

/// Its kernels in one text, as its traverse.cl includes them; the vendor chooses its shapes.
std::string source_of(const std::string& folder, const std::string& platform) {
    const auto text = [&](const std::string& name) {
        const auto bytes = read_file(folder + "/" + name);
        return std::string(bytes.begin(), bytes.end());
    };
    std::string all = text("traverse.cl");
    for (std::size_t at; (at = all.find("#include \"")) != std::string::npos;) {
        const std::size_t name = at + 10, quote = all.find('"', name),
                          end = std::min(all.find('\n', at), all.size());
        all.replace(at, end - at, "\n" + text(all.substr(name, quote - name)) + "\n");
    }
    // Its casts drop the address space, which compilers of OpenCL C 1.2 refuse.
    const std::string cast = "const float* p = (float*)&cwbvhNodes";
    for (std::size_t at; (at = all.find(cast)) != std::string::npos;)
        all.replace(at, cast.size(), "const global float* p = (const global float*)&cwbvhNodes");
    const bool is_nvidia = platform.find("NVIDIA") != std::string::npos,
               is_amd = platform.find("AMD") != std::string::npos,
               is_intel = platform.find("Intel") != std::string::npos;
    return std::string(is_nvidia  ? "#define ISNVIDIA\n"
                       : is_amd   ? "#define ISAMD\n"
                       : is_intel ? "#define ISINTEL\n"
                                  : "") +
           all;
}

}  // namespace

struct TinybvhTracer::State {
    explicit State(Device& d) : device(d) {}
    Device& device;
    std::vector<tinybvh::bvhvec4> corners;
    std::optional<tinybvh::BVH8_CWBVH> eight;
    std::optional<tinybvh::BVH4_GPU> four;
    Buffer nodes, triangles, rays;
    Kernel kernel;
    std::size_t count = 0;
};

bool TinybvhTracer::available() { return true; }

TinybvhTracer::TinybvhTracer(Device& device, const RayScene& scene, const std::string& layout,
                             const std::string& kernels)
    : state_(std::make_unique<State>(device)) {
    State& s = *state_;
    for (const uvec3& t : scene.mesh.triangles)
        for (const std::uint32_t corner : {t.x, t.y, t.z}) {
            const vec3& p = scene.mesh.positions[corner];
            s.corners.emplace_back(p.x, p.y, p.z, 0.0f);
        }
    const auto triangles = std::uint32_t(scene.mesh.triangles.size());
    const Program program =
        device.build_source("tinybvh/traverse.cl", source_of(kernels, device.info().platform));
    if (layout == "cwbvh") {
        s.eight.emplace().BuildHQ(s.corners.data(), triangles);
        s.nodes = device.allocate(s.eight->usedBlocks * sizeof(tinybvh::bvhvec4), s.eight->bvh8Data);
        s.triangles = device.allocate(s.eight->idxCount * 3 * sizeof(tinybvh::bvhvec4), s.eight->bvh8Tris);
        s.kernel = program.kernel("batch_cwbvh");
    } else {
        s.four.emplace().BuildHQ(s.corners.data(), triangles);
        s.nodes = device.allocate(s.four->usedBlocks * sizeof(tinybvh::bvhvec4), s.four->bvh4Data);
        s.kernel = program.kernel("batch_gpu4way");
    }
}

void TinybvhTracer::set_rays(const std::vector<dev::Ray>& rays) {
    State& s = *state_;
    s.count = rays.size();
    // Its kernels guard against no excess of a launch.
    std::vector<BatchRay> batch((rays.size() + 63) / 64 * 64);
    for (std::size_t i = 0; i < batch.size(); ++i) {
        const dev::Ray& ray = rays[std::min(i, rays.size() - 1)];
        for (int axis = 0; axis < 3; ++axis) {
            const float d = ray.direction[axis];
            batch[i].origin[axis] = ray.origin[axis], batch[i].direction[axis] = d;
            batch[i].reciprocal[axis] = std::fabs(d) > 1e-12f ? 1 / d : std::copysign(1e30f, d);
        }
        batch[i].hit[0] = 1e30f;
    }
    s.rays = s.device.upload(batch);
}

void TinybvhTracer::trace() {
    State& s = *state_;
    Arguments arguments;
    arguments.add(s.nodes);
    if (s.triangles) arguments.add(s.triangles);
    arguments.add(s.rays);
    s.device.run(s.kernel, arguments, (s.count + 63) / 64 * 64, 64);
    s.device.finish();
}

std::vector<float> TinybvhTracer::distances() {
    std::vector<float> all;
    for (const BatchRay& ray : state_->device.download<BatchRay>(state_->rays)) all.push_back(ray.hit[0]);
    all.resize(state_->count);
    return all;
}

#else

struct TinybvhTracer::State {};
bool TinybvhTracer::available() { return false; }
TinybvhTracer::TinybvhTracer(Device&, const RayScene&, const std::string&, const std::string&) {}
void TinybvhTracer::set_rays(const std::vector<dev::Ray>&) {}
void TinybvhTracer::trace() {}
std::vector<float> TinybvhTracer::distances() { return {}; }

#endif

TinybvhTracer::~TinybvhTracer() = default;

}  // namespace triad::bench
