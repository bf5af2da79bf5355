#pragma once
/// "Model only what a scene needs": observable facts of a scene that become compile-time options of the
/// kernels.
#include <map>
#include <span>
#include <string>
#include <vector>

#include "pack/settings.h"
#include "scene/scene.h"

namespace triad {

/// One member per option of kernels/features.h, same sentence.
struct Features {
    bool instances = true, alpha_test = true, textures = true, normal_maps = true, vertex_colours = true;
    bool texture_levels = true;
    bool specular = true, transmission = true, dispersion = true, priorities = true, unlit = true;
    bool triangle_lights = true, near_lights = true, punctual_lights = true, environment_map = true,
         lens = true, bins = true;
    bool clearcoat = true, sheen = true, anisotropy = true, iridescence = true, diffuse_transmission = true;
    bool light_tree = true;
    bool independent_samples = true, ray_starts = true, photons = true, gather = true, light_spectra = true;
};

struct PackedScene;

/// What is read off the scene alone: its materials, lights and geometry; the rest is on.
Features facts_of(const Scene& scene);

/// PackedScene::facts, what the packing decided (instances, photons), and what the settings ask for.
Features features_of(const PackedScene& packed, const RenderSettings& settings);

/// What either has.
Features united(const Features& a, const Features& b);

/// An option of kernels/features.h: TRIAD_ and its name.
struct FeatureOption {
    const char* name;
    bool Features::*member;

    std::string words() const;  ///< "alpha test"
};

/// Every member of Features once.
std::span<const FeatureOption> feature_options();

/// Device options: "-D TRIAD_...=0|1".
std::map<std::string, std::string> options_of(const Features& features);

/// Names of what was left out, for -v and JSON.
std::vector<std::string> left_out(const Features& features);

}  // namespace triad
