#include "trace/device_scene.h"

#include "base/colour.h"
#include "pack/albedo_tables.h"
#include "pack/ray_filter.h"

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
    const auto add = [&](const Buffer& buffer) {
        bytes_ += buffer.bytes();
        arrays_.add(buffer);
    };
    const auto copy = [&](const auto& values) { add(device.upload(values)); };
    const auto share = [&]<class T>(const AlignedVector<T>& values) {
        add(device.share(std::span<const T>(values), packed_));
    };
    const PackedSurfaces& surfaces = *packed_->surfaces;
    // The order of SCENE_PARAMETERS in kernels/shading/scene.h, between the frame and the filter.
    share(packed_->bvh.nodes);
    share(packed_->bvh.blocks);
    copy(packed_->instance_table);
    share(packed_->triangles);
    share(packed_->geometries);
    share(packed_->normals);
    share(packed_->tangents);
    share(packed_->uvs);
    share(packed_->colours);
    copy(surfaces.materials);
    copy(surfaces.texture_uses);
    copy(surfaces.textures);
    share(surfaces.texels);
    copy(srgb_table());
    copy(albedo_tables());
    copy(packed_->lights);
    copy(packed_->light_cdf);
    share(surfaces.env_texels);
    share(surfaces.env_rows);
    share(surfaces.env_columns);
    copy(surfaces.env_cosines);
    copy(packed_->spectrum);
    copy(surfaces.indices);
}

Arguments DeviceScene::arguments(const Buffer& frame, const Buffer& ray_filter,
                                 const PhotonMapBuffers& photon_map) const {
    return Arguments()
        .add(frame)
        .add(arrays_)
        .add(ray_filter)
        .add(photon_map.map)
        .add(photon_map.photons)
        .add(photon_map.ends);
}

Arguments scene_arguments(Device& device, const PackedScene& packed, const RenderSettings& settings,
                          const PhotonMapBuffers& photon_map) {
    const DeviceScene scene(device, std::make_shared<PackedScene>(packed));
    return scene.arguments(device.upload(std::vector<dev::Frame>{frame_of(packed, settings)}),
                           device.upload(ray_filter_tables(settings)), photon_map);
}

}  // namespace triad
