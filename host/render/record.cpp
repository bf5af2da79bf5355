#include "render/record.h"

#include <algorithm>

#include "render/renderer_state.h"

namespace triad {
namespace {

constexpr std::uint64_t batch = 512;  ///< paths in one launch: 2.6 MB of vertices

vec3 vec3_of(const float v[3]) { return {v[0], v[1], v[2]}; }

bool any(const vec3& v) { return v != vec3(0.0f); }

}  // namespace

const std::vector<std::string>& Renderer::light_sources() const { return state_->source_names; }

void Renderer::record_pixel(unsigned x, unsigned y, SampleRange range,
                            const std::function<void(const RecordedPath&)>& receive) {
    State& s = *state_;
    const Kernel kernel =
        s.device.build(program_of(s.settings, "record"), options_of(s.features)).kernel("record_paths");
    const Buffer records = s.device.allocate(batch * sizeof(dev::PathRecord));
    const Buffer paths = s.device.allocate(batch * PATH_VERTICES * sizeof(dev::PathVertex));
    const std::uint32_t sky = static_cast<std::uint32_t>(s.source_names.size() - 1);
    for (std::uint64_t first = range.begin; first < range.end; first += batch) {
        const auto count = static_cast<std::uint32_t>(std::min(batch, range.end - first));
        s.device.run(kernel,
                     Arguments()
                         .add(s.scene.arguments)
                         .add(records)
                         .add(paths)
                         .add(std::uint32_t(x))
                         .add(std::uint32_t(y))
                         .add(std::uint32_t(first))
                         .add(std::uint32_t(first >> 32))
                         .add(count),
                     count);
        s.device.finish();
        const auto headers = s.device.download<dev::PathRecord>(records);
        const auto vertices = s.device.download<dev::PathVertex>(paths);
        for (std::uint32_t i = 0; i < count; ++i) {
            const dev::PathRecord& r = headers[i];
            RecordedPath path{first + i, r.bin, r.half_index, r.vertices, r.rays, {}, {}};
            path.value = {r.value[0], r.value[1], r.value[2], r.value[3]};
            for (std::uint32_t k = 0; k < std::min<std::uint32_t>(r.vertices, PATH_VERTICES); ++k) {
                const dev::PathVertex& v = vertices[std::size_t(i) * PATH_VERTICES + k];
                const bool away = v.primitive == TRIAD_NONE;
                RecordedVertex to;
                to.position = dvec3(vec3_of(v.position)) + (away ? dvec3(0.0) : s.packed.origin);
                to.material = v.material, to.event = v.event, to.end = v.end;
                to.found = vec3_of(v.found), to.direct = vec3_of(v.direct);
                to.throughput = vec3_of(v.throughput);
                to.edge = v.edge, to.wavelength = v.wavelength;
                to.found_source = !any(to.found) ? TRIAD_NONE : away ? sky : v.material;
                to.direct_source = any(to.direct) ? s.light_source[v.light] : TRIAD_NONE;
                path.vertices.push_back(to);
            }
            receive(path);
        }
    }
}

void Renderer::State::name_sources(const Scene& from) {
    const auto add = [&](const char* kind, const auto& things) {
        for (std::size_t i = 0; i < things.size(); ++i)
            source_names.push_back(std::string(kind) + " " +
                                   (things[i].name.empty() ? std::to_string(i) : '"' + things[i].name + '"'));
    };
    add("material", from.materials);
    std::uint32_t punctual = static_cast<std::uint32_t>(source_names.size());
    add("light", from.lights);
    source_names.push_back("environment");
    for (const dev::Light& l : packed.lights)
        light_source.push_back(
            l.type == LIGHT_TRIANGLE      ? packed.geometries[packed.triangles[l.primitive].geometry].material
            : l.type == LIGHT_ENVIRONMENT ? static_cast<std::uint32_t>(source_names.size() - 1)
                                          : punctual++);
}

}  // namespace triad
