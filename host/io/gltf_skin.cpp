#include "io/gltf_skin.h"

#include <cmath>

#include "base/error.h"
#include "io/gltf_accessor.h"

namespace triad::gltf {

Skin skin_at(File& file, PosedNodes& nodes, int index) {
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
        const dmat4 to_world = nodes.to_world(std::size_t(joint));
        const dvec3 place(to_world[3]);
        for (int k = 0; k < 12; ++k)
            if (!std::isfinite(to_world[k / 3][k % 3]))
                throw Error(Exit::scene,
                            what + ": " +
                                label("node", std::size_t(joint), file.nodes[std::size_t(joint)].name) +
                                " has a transform whose elements are no numbers.");
        skin.centre += place / double(count);
    }
    const dmat4 rebase = glm::translate(dmat4(1.0), -skin.centre);
    std::size_t damaged = 0;
    for (std::size_t i = 0; i < count; ++i) {
        dmat4 bind(1.0);
        bool finite = true;
        for (std::size_t k = 0; k < 16 && !inverse_bind.empty(); ++k) {
            const double x = k % 4 == 3 ? double(k == 15) : double(inverse_bind[16 * i + k]);
            bind[int(k / 4)][int(k % 4)] = x;
            finite = finite && std::isfinite(x);
        }
        if (!finite) bind = dmat4(1.0), ++damaged;
        skin.joints.push_back(rebase * nodes.to_world(std::size_t(source.joints[i])) * bind);
    }
    if (damaged > 0)
        file.fault(what + ": inverseBindMatrices (accessor " + std::to_string(source.inverseBindMatrices) +
                   ") has " + std::to_string(damaged) + " of " + std::to_string(count) +
                   " matrices with elements that are no finite numbers; they become the identity.");
    return skin;
}

}  // namespace triad::gltf
