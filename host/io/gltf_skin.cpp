#include "io/gltf_skin.h"

#include <cmath>

#include "base/error.h"
#include "io/gltf_accessor.h"

namespace triad::gltf {

Skin skin_at(File& file, Nodes& nodes, int index) {
    const tinygltf::Skin& source = file.model.skins[std::size_t(index)];
    const std::string what = label("skin", std::size_t(index), source.name);
    const std::size_t count = source.joints.size();
    std::vector<float> inverse_bind;
    if (source.inverseBindMatrices >= 0) {
        inverse_bind =
            read_floats(file, source.inverseBindMatrices, 16, Integers::none, what + ": inverseBindMatrices");
        if (inverse_bind.size() < 16 * count)
            throw Error(Exit::scene, what + " has " + std::to_string(inverse_bind.size() / 16) +
                                         " inverseBindMatrices for " + std::to_string(count) + " joints.");
    }
    Skin skin;
    file.charge(count * sizeof(dmat4), what);
    for (const int joint : source.joints) {
        const dvec3 place(nodes.to_world(std::size_t(joint))[3]);
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(place[axis]))
                throw Error(Exit::scene,
                            what + ": " +
                                label("node", std::size_t(joint), file.model.nodes[std::size_t(joint)].name) +
                                " has a transform whose elements are no numbers.");
        skin.centre += place / double(count);
    }
    const dmat4 rebase = glm::translate(dmat4(1.0), -skin.centre);
    for (std::size_t i = 0; i < count; ++i) {
        dmat4 bind(1.0);
        for (std::size_t k = 0; k < 16 && !inverse_bind.empty(); ++k)
            bind[int(k / 4)][int(k % 4)] = k % 4 == 3 ? double(k == 15) : double(inverse_bind[16 * i + k]);
        skin.joints.push_back(rebase * nodes.to_world(std::size_t(source.joints[i])) * bind);
    }
    return skin;
}

}  // namespace triad::gltf
