#include "embree_tracer.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "base/parallel_for.h"
#include "clock.h"

#if TRIAD_EMBREE
#include <embree3/rtcore.h>
#endif

namespace triad::bench {

#if TRIAD_EMBREE

namespace {
constexpr std::size_t grain = 1u << 14;

RTCRay to_embree(const dev::Ray& r) {
    RTCRay ray{};
    ray.org_x = r.origin[0], ray.org_y = r.origin[1], ray.org_z = r.origin[2];
    ray.dir_x = r.direction[0], ray.dir_y = r.direction[1], ray.dir_z = r.direction[2];
    ray.tnear = std::numeric_limits<float>::min();  // as in Triad, a hit at t = 0 does not count
    ray.tfar = r.t_max;
    ray.mask = ~0u;
    return ray;
}
}  // namespace

struct EmbreeTracer::State {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    double build_seconds = 0;
    ~State() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

bool EmbreeTracer::available() { return true; }

EmbreeTracer::EmbreeTracer(const RayScene& scene, bool robust) : state_(std::make_unique<State>()) {
    const RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto& [positions, triangles] = std::tie(scene.mesh.positions, scene.mesh.triangles);
    auto* vertex = static_cast<vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), positions.size()));
    std::copy(positions.begin(), positions.end(), vertex);
    auto* index = static_cast<uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(uvec3), triangles.size()));
    std::copy(triangles.begin(), triangles.end(), index);
    const double start = now();
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(state_->scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(state_->scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcCommitScene(state_->scene);
    state_->build_seconds = now() - start;
}

double EmbreeTracer::closest(const std::vector<dev::Ray>& rays, std::vector<dev::Hit>& hits) const {
    const double start = now();
    parallel_for(rays.size(), grain, [&](std::size_t begin, std::size_t end) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = begin; i < end; ++i) {
            RTCRayHit query{};
            query.ray = to_embree(rays[i]);
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(state_->scene, &context, &query);
            const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
            hits[i] = {query.ray.tfar,       query.hit.u, query.hit.v, hit ? query.hit.primID : TRIAD_NONE,
                       hit ? 0 : TRIAD_NONE, {}};
        }
    });
    return now() - start;
}

double EmbreeTracer::occluded(const std::vector<dev::Ray>& rays, std::vector<std::uint32_t>& occluded) const {
    const double start = now();
    parallel_for(rays.size(), grain, [&](std::size_t begin, std::size_t end) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = begin; i < end; ++i) {
            RTCRay query = to_embree(rays[i]);
            rtcOccluded1(state_->scene, &context, &query);
            occluded[i] = query.tfar < 0 ? 1 : 0;
        }
    });
    return now() - start;
}

double EmbreeTracer::build_seconds() const { return state_->build_seconds; }

#else

struct EmbreeTracer::State {};
bool EmbreeTracer::available() { return false; }
EmbreeTracer::EmbreeTracer(const RayScene&, bool) {}
double EmbreeTracer::closest(const std::vector<dev::Ray>&, std::vector<dev::Hit>&) const { return 0; }
double EmbreeTracer::occluded(const std::vector<dev::Ray>&, std::vector<std::uint32_t>&) const { return 0; }
double EmbreeTracer::build_seconds() const { return 0; }

#endif

EmbreeTracer::~EmbreeTracer() = default;

}  // namespace triad::bench
