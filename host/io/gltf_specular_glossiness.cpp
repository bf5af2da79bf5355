/// KHR_materials_pbrSpecularGlossiness, an older model of materials, as the one that is rendered.
#include "io/gltf_specular_glossiness.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace triad::gltf {
namespace {

/// Roughness where Material::metallic_roughness_texture has it, from glossiness in alpha.
template <class T>
void roughen(std::vector<std::uint8_t>& texels, double factor) {
    constexpr double one = std::numeric_limits<T>::max();
    for (std::size_t i = 0; i + 4 * sizeof(T) <= texels.size(); i += 4 * sizeof(T)) {
        T rgba[4];
        std::memcpy(rgba, &texels[i], sizeof rgba);
        const T rough[4] = {0, T(std::lround(one - factor * double(rgba[3]))), 0, T(one)};
        std::memcpy(&texels[i], rough, sizeof rough);
    }
}

}  // namespace

void make_roughness(Image& image, double glossiness) {
    if (image.bits == 16)
        roughen<std::uint16_t>(image.texels, glossiness);
    else
        roughen<std::uint8_t>(image.texels, glossiness);
}

}  // namespace triad::gltf
