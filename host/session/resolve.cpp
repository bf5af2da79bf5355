#include "session/resolve.h"

#include <algorithm>

#include "base/error.h"
#include "session/metadata.h"

namespace triad {

Reconstruction reconstruction_for(const Film& film, const std::string& name,
                                  const ReconstructRequest& request) {
    const Reconstruction method = request.make(uvec2(film.bins_x, film.bins_y));
    if (has_filtered_rays(film) != (method.ray_start == RayStart::filter))
        throw Error(Exit::usage,
                    has_filtered_rays(film)
                        ? "The rays of " + name +
                              " started by a panel's filter: name that panel and the method that rendered it "
                              "(--reconstruct random3 or random3:shared)."
                        : "--reconstruct " + method.method +
                              " needs rays that start by its filter; the film " + name +
                              " has others. Render it with that method.");
    if (film.bins_x != method.bins_x || film.bins_y != method.bins_y)
        throw Error(Exit::usage, "--bins: the film " + name + " has " + std::to_string(film.bins_x) + "x" +
                                     std::to_string(film.bins_y) + " bins per pixel.");
    return method;
}

Reconstruction reconstruction_for_pictures(const ReconstructRequest& request) {
    const Reconstruction method = request.make();
    if (method.ray_start == RayStart::filter)
        throw Error(Exit::usage,
                    "--reconstruct " + method.method + " is a way to render, not to filter a picture.");
    return method;
}

BinImage bins_of(const Picture& picture, const std::string& name, const Reconstruction& method) {
    const Channel* channels[] = {picture.find("R"), picture.find("G"), picture.find("B"), picture.find("A")};
    if (std::count(channels, channels + 3, nullptr) > 0)
        throw Error(Exit::scene, name + " has no channels R, G and B.");
    BinImage image;
    image.columns = picture.width, image.rows = picture.height;
    image.bins_x = method.bins_x, image.bins_y = method.bins_y;
    image.encoded = picture.encoded;
    image.rgba.resize(std::size_t(picture.width) * picture.height * 4, 1.0f);
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; channels[c] && i < image.rgba.size() / 4; ++i)
            image.rgba[4 * i + c] = channels[c]->values[i];
    return image;
}

}  // namespace triad
