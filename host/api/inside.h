#pragma once
/// What scenes and films hold.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "session/prepare.h"
#include "triad/film.h"
#include "triad/scene.h"

namespace triad::api {

struct Scene::Inside {
    RenderRequest request;  ///< with the options of load()
    LoadedScene loaded;
};

struct Film::Inside {
    triad::Film film;
    Metadata facts;  ///< what its reconstruction does not change
    std::map<std::string, std::vector<float>> layers;
    OutputStyle style;       ///< as it was rendered for
    bool is_chosen = false;  ///< the style has the reconstruction that it was rendered for
    ReconstructRequest reconstruct;
    bool complete = true;
    std::string selector;                         ///< of the device
    mutable std::optional<triad::Device> device;  ///< none: not opened yet
};

}  // namespace triad::api
