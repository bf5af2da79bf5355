#pragma once
/// The files of cases, each of which adds its rows.
#include <vector>

#include "check/check.h"

namespace triad {

void add_maths(std::vector<CheckCase>& cases);
void add_layout(std::vector<CheckCase>& cases);
void add_random(std::vector<CheckCase>& cases);
void add_sampling(std::vector<CheckCase>& cases);
void add_traversal(std::vector<CheckCase>& cases);
void add_traversal_input(std::vector<CheckCase>& cases);
void add_traversal_reference(std::vector<CheckCase>& cases);
void add_any_bits(std::vector<CheckCase>& cases);
void add_ggx(std::vector<CheckCase>& cases);
void add_bsdf(std::vector<CheckCase>& cases);
void add_bsdf_energy(std::vector<CheckCase>& cases);
void add_bsdf_layers(std::vector<CheckCase>& cases);
void add_bsdf_grazing(std::vector<CheckCase>& cases);
void add_lights(std::vector<CheckCase>& cases);
void add_near_lights(std::vector<CheckCase>& cases);
void add_light_samplers(std::vector<CheckCase>& cases);
void add_light_tree(std::vector<CheckCase>& cases);
void add_spectral(std::vector<CheckCase>& cases);
void add_light_spectra(std::vector<CheckCase>& cases);
void add_film(std::vector<CheckCase>& cases);
void add_photons(std::vector<CheckCase>& cases);
void add_textures(std::vector<CheckCase>& cases);

void add_invariance(std::vector<CheckCase>& cases);
void add_energy(std::vector<CheckCase>& cases);
void add_radiometry(std::vector<CheckCase>& cases);
void add_spectral_pictures(std::vector<CheckCase>& cases);
void add_hard_pictures(std::vector<CheckCase>& cases);
void add_photon_pictures(std::vector<CheckCase>& cases);
void add_texture_pictures(std::vector<CheckCase>& cases);

}  // namespace triad
