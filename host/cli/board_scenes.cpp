#include "cli/board_scenes.h"

#include <cstdlib>

#include "io/io.h"
#include "session/prepare.h"

namespace triad {
namespace {

KnownPicture known_picture(const std::filesystem::path& path) {
    const Picture picture = read_picture(path);
    const auto number = [&](const char* name) {
        const auto found = picture.metadata.find(name);
        const double value =
            found == picture.metadata.end() ? 0 : std::strtod(found->second.c_str(), nullptr);
        if (!(value > 0))
            throw Error(Exit::scene, path.string() + " is no reference: it has no " + name + ".");
        return value;
    };
    KnownPicture known{{picture.width, picture.height, {}}, number("triad:spp"), number("triad:relmse")};
    const Channel* channels[] = {picture.find("R"), picture.find("G"), picture.find("B")};
    for (const Channel* channel : channels)
        if (!channel) throw Error(Exit::scene, path.string() + " is no reference: a colour is missing.");
    known.mean.rgb.resize(std::size_t(picture.width) * picture.height * 3);
    for (std::size_t i = 0; i < known.mean.rgb.size(); ++i)
        known.mean.rgb[i] = channels[i % 3]->values[i / 3];
    return known;
}

}  // namespace

BoardScene board_scene(const NamedOptions& scene, const std::filesystem::path& folder) {
    BoardScene board;
    board.name = scene.name;
    board.known = known_picture(folder / "references" / (scene.name + ".exr"));
    RenderRequest request = render_options({}, scene, {});
    request.size = uvec2(board.known.mean.width, board.known.mean.height);
    // How many photons a pilot chooses depends on the device: another board would do other work.
    request.integrator = Integrator::path;
    board.scene = load_scene(request);
    board.settings = settings_of(request, board.scene);
    return board;
}

}  // namespace triad
