// A scene with its data in one file, .glb.
#include "fuzz/targets/target.h"

TRIAD_FUZZ_TARGET(glb) { triad::fuzz::load(triad::fuzz::file_of(input)); }
