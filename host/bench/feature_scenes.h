#pragma once
/// Scenes that use exactly one feature more than another scene.
#include <string>
#include <vector>

#include "pack/features.h"
#include "pack/settings.h"
#include "scene/scene.h"

namespace triad {

struct FeatureScene {
    Scene scene;
    RenderSettings settings;
};

/// `with` uses the feature, `without` does not and needs as little else as possible.
struct FeatureCase {
    FeatureOption feature;
    FeatureScene without, with;
};

/// One case for each of feature_options(), size x size pixels.
std::vector<FeatureCase> feature_cases(unsigned size);

}  // namespace triad
