#include "trace/device_scene.h"

#include "base/colour.h"
#include "pack/albedo_tables.h"
#include "pack/ray_filter.h"
#include "trace/node_format.h"

namespace triad {
namespace {

const std::vector<float>& srgb_table() {
    static const std::vector<float> table = [] {
        std::vector<float> values;
        for (int i = 0; i < 256; ++i) values.push_back(static_cast<float>(srgb_decode(i / 255.0)));
        return values;
    }();
    return table;
}

}  // namespace

DeviceScene::DeviceScene(Device& device, std::shared_ptr<const PackedScene> packed)
    : device_(device), packed_(std::move(packed)) {
    const auto add = [&]<class T>(DeviceArray<T>& to, DeviceArray<T> array) {
        bytes_ += array.bytes();
        to = std::move(array);
    };
    const auto copy = [&]<class T>(DeviceArray<T>& to, const std::vector<T>& values) {
        add(to, device.upload(values));
    };
    const auto share = [&]<class T>(DeviceArray<T>& to, const AlignedVector<T>& values) {
        add(to, device.share(std::span<const T>(values), packed_));
    };
    const PackedSurfaces& surfaces = *packed_->surfaces;
    dev::SceneArguments& a = arrays_;
    add(a.nodes, nodes_on(device, packed_->bvh, packed_));
    share(a.blocks, packed_->bvh.blocks);
    share(a.instances, packed_->instance_table);
    share(a.triangles, packed_->triangles);
    share(a.geometries, packed_->geometries);
    share(a.normals, packed_->normals);
    share(a.tangents, packed_->tangents);
    share(a.uvs, packed_->uvs);
    share(a.colours, packed_->colours);
    copy(a.materials, surfaces.materials);
    copy(a.extensions, surfaces.extensions);
    copy(a.texture_uses, surfaces.texture_uses);
    copy(a.textures, surfaces.textures);
    share(a.texels, surfaces.texels);
    copy(a.srgb, srgb_table());
    add(a.albedo, device.upload(albedo_tables()));
    copy(a.film_responses, surfaces.film_responses);
    copy(a.lights, packed_->lights);
    copy(a.light_cdf, packed_->light_cdf);
    copy(a.light_nodes, packed_->light_tree.nodes);
    copy(a.light_trails, packed_->light_tree.trails);
    share(a.env_texels, surfaces.env_texels);
    share(a.env_rows, surfaces.env_rows);
    share(a.env_columns, surfaces.env_columns);
    copy(a.env_cosines, surfaces.env_cosines);
    copy(a.spectrum, packed_->spectrum);
    copy(a.indices, surfaces.indices);
}

MemoryUse DeviceScene::memory() const {
    MemoryUse use;
#define TRIAD_ARRAY(type, name) \
    if (arrays_.name.bytes() > 0) use.emplace_back(#name, arrays_.name.bytes());
    SCENE_LIST(TRIAD_ARRAY, TRIAD_ARRAY)
#undef TRIAD_ARRAY
    return use;
}

Arguments DeviceScene::arguments(const DeviceArray<dev::Frame>& frame, const DeviceArray<float>& ray_filter,
                                 const PhotonMapBuffers& photon_map) const {
    dev::SceneArguments a = arrays_;
    a.frame = frame;
    a.ray_filter = ray_filter;
    a.photon_map = photon_map.map;
    a.photons = photon_map.photons;
    a.photon_ends = photon_map.ends;
    return arguments_of(a);
}

Arguments scene_arguments(Device& device, const PackedScene& packed, const RenderSettings& settings,
                          const PhotonMapBuffers& photon_map) {
    const DeviceScene scene(device, std::make_shared<PackedScene>(packed));
    return scene.arguments(device.upload(std::vector<dev::Frame>{frame_of(packed, settings)}),
                           device.upload(ray_filter_tables(settings)), photon_map);
}

}  // namespace triad
