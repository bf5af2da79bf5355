#include "io/gltf_image_light.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/colour.h"
#include "base/memory_limit.h"
#include "io/gltf_images.h"
#include "io/gltf_members.h"
#include "io/gltf_node.h"
#include "scene/environment_maps.h"

namespace triad::gltf {
namespace {

using tinygltf::Value;

const char* const name = "EXT_lights_image_based";

/// What each value of a channel of 8 or 16 bits means.
std::vector<float> decoded_values(unsigned bits) {
    std::vector<float> values(std::size_t(1) << bits);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float(srgb_decode(double(i) / double(values.size() - 1)));
    return values;
}

/// R, G and B over what alpha says they were multiplied by ("RGBD"); images without alpha have 1 there.
template <class T>
std::vector<float> radiance_of(const Image& image, double intensity) {
    const std::vector<float> decoded = decoded_values(image.bits);
    const T* texel = reinterpret_cast<const T*>(image.texels.data());
    const std::size_t count = std::size_t(image.width) * image.height;
    std::vector<float> rgb(count * 3);
    for (std::size_t i = 0; i < count; ++i, texel += 4) {
        const double divisor = std::max(double(texel[3]) / double(T(~T(0))), 1.0 / 255);
        for (std::size_t c = 0; c < 3; ++c) rgb[i * 3 + c] = float(intensity * decoded[texel[c]] / divisor);
    }
    return rgb;
}

Image decoded_face(File& file, const Value& face) {
    const ImageSource& source = file.images[std::size_t(face.GetNumberAsInt())];
    std::string damage;
    Image image = decode_image(source.name, bytes_of(source), &damage);
    if (!damage.empty())
        file.fault(source.name + " is damaged (" + damage + "); what could be decoded of it is used.");
    return image;
}

CubeMap cube_of(File& file, const Value& light, double intensity, const std::string& what) {
    const Value& levels = light.Get("specularImages");
    CubeMap cube;
    for (std::size_t i = 0; i < cube.faces.size(); ++i) {
        const Image image = decoded_face(file, levels.Get(0).Get(int(i)));
        const auto size = [](const Image& im) {
            return std::to_string(im.width) + " x " + std::to_string(im.height) + " texels";
        };
        if (image.width != image.height)
            throw Error(Exit::scene, what + ": " + image.name + " has " + size(image) +
                                         ", but faces of a cube are square.");
        if (i == 0) {
            cube.size = image.width;
            const std::uint64_t columns = columns_for(cube.size),
                                texels = columns * columns / 2 + std::uint64_t(cube.size) * cube.size * 6;
            require_memory(texels * 3 * sizeof(float), "The environment of " + what);
        }
        if (image.width != cube.size)
            throw Error(Exit::scene, what + ": " + image.name + " has " + size(image) + ", but face 0 has " +
                                         std::to_string(cube.size) + " x " + std::to_string(cube.size) + ".");
        cube.faces[i] = image.bits == 16 ? radiance_of<std::uint16_t>(image, intensity)
                                         : radiance_of<std::uint8_t>(image, intensity);
    }
    const double said = number(light, "specularImageSize", cube.size);
    if (said != cube.size)
        file.warn(what + " says that its faces have " + std::to_string(std::uint64_t(said)) +
                  " texels along an edge, but they have " + std::to_string(cube.size) + ".");
    return cube;
}

IrradianceHarmonics harmonics_of(const Value& light, double intensity) {
    IrradianceHarmonics harmonics;
    for (std::size_t i = 0; i < harmonics.size(); ++i)
        for (int c = 0; c < 3; ++c)
            harmonics[i][c] =
                intensity * light.Get("irradianceCoefficients").Get(int(i)).Get(c).GetNumberAsDouble();
    return harmonics;
}

}  // namespace

std::optional<EnvironmentMap> image_light(File& file, std::size_t scene) {
    const Value* reference = find_extension(file.model.scenes[scene].extensions, name);
    if (!reference) return std::nullopt;
    const std::size_t which = std::size_t(number(*reference, "light", 0));
    const Value& light = file.model.extensions.at(name).Get("lights").Get(int(which));
    const std::string own = light.Has("name") && light.Get("name").IsString()
                                ? light.Get("name").Get<std::string>()
                                : std::string();
    const std::string what = label("image-based light", which, own);
    const double intensity = number(light, "intensity", 1.0);
    dquat rotation(1.0, 0.0, 0.0, 0.0);
    if (light.Has("rotation")) {
        const Value& r = light.Get("rotation");
        const auto at = [&r](int i) { return r.Get(i).GetNumberAsDouble(); };
        rotation = unit_quaternion(dquat(at(3), at(0), at(1), at(2)), what);
    }
    if (light.Has("specularImages")) return environment_of(cube_of(file, light, intensity, what), rotation);
    if (light.Has("irradianceCoefficients")) return environment_of(harmonics_of(light, intensity), rotation);
    throw Error(Exit::scene, what + " has neither specularImages nor irradianceCoefficients.");
}

}  // namespace triad::gltf
