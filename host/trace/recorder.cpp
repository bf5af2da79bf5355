#include "trace/recorder.h"
#include "trace/program.h"

#include <algorithm>

namespace triad {
namespace {

constexpr std::uint64_t batch = 512;  ///< paths in one launch: 2.6 MB of vertices

vec3 vec3_of(const float v[3]) { return {v[0], v[1], v[2]}; }

bool any(const vec3& v) { return v != vec3(0.0f); }

RecordedVertex vertex_of(const dev::PathVertex& v, const PackedScene& packed) {
    const bool away = v.primitive == TRIAD_NONE;
    const auto sky = static_cast<std::uint32_t>(packed.light_sources.size() - 1);
    RecordedVertex to;
    to.position = dvec3(vec3_of(v.position)) + (away ? dvec3(0.0) : packed.origin);
    to.material = v.material, to.event = v.event, to.end = v.end;
    to.found = vec3_of(v.found), to.direct = vec3_of(v.direct);
    to.throughput = vec3_of(v.throughput);
    to.edge = v.edge, to.wavelength = v.wavelength;
    to.found_source = !any(to.found) ? TRIAD_NONE : away ? sky : v.material;
    to.direct_source = any(to.direct) ? packed.source_of_light[v.light] : TRIAD_NONE;
    return to;
}

}  // namespace

void record_paths(Tracer& tracer, unsigned x, unsigned y, SampleRange range,
                  const std::function<void(const RecordedPath&)>& receive) {
    Device& device = tracer.device();
    const Kernel kernel = device.build(program_of(tracer.settings(), "record"), options_of(tracer.features()))
                              .kernel("record_paths");
    dev::RecordPathsArguments own{.records = device.allocate_array<dev::PathRecord>(batch),
                                  .vertices = device.allocate_array<dev::PathVertex>(batch * PATH_VERTICES),
                                  .x = x,
                                  .y = y,
                                  .first_sample_low = 0,
                                  .first_sample_high = 0,
                                  .sample_count = 0};
    for (std::uint64_t first = range.begin; first < range.end; first += batch) {
        const auto count = static_cast<std::uint32_t>(std::min(batch, range.end - first));
        own.first_sample_low = std::uint32_t(first), own.first_sample_high = std::uint32_t(first >> 32);
        own.sample_count = count;
        device.run(kernel, Arguments(tracer.arguments()).add(arguments_of(own)), count);
        device.finish();
        const auto headers = device.download<dev::PathRecord>(own.records);
        const auto vertices = device.download<dev::PathVertex>(own.vertices);
        for (std::uint32_t i = 0; i < count; ++i) {
            const dev::PathRecord& r = headers[i];
            RecordedPath path{first + i, r.bin, r.half_index, r.vertices, r.rays, {}, {}};
            path.value = {r.value[0], r.value[1], r.value[2], r.value[3]};
            for (std::uint32_t k = 0; k < std::min<std::uint32_t>(r.vertices, PATH_VERTICES); ++k)
                path.vertices.push_back(
                    vertex_of(vertices[std::size_t(i) * PATH_VERTICES + k], tracer.scene().packed()));
            receive(path);
        }
    }
}

}  // namespace triad
