// A scene as text, .gltf.
#include "fuzz/targets/target.h"

TRIAD_FUZZ_TARGET(gltf_json) { triad::fuzz::load(triad::fuzz::file_of(input)); }
