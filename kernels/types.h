/* The border: every struct and constant that host and device share. C++ and OpenCL C read these same files.
 *
 * Rules: 4-byte scalars and arrays of them only (no vector types, pointers, enums, bools), so that every
 * compiler lays them out alike; sizes are asserted here on both sides, offsets by the device test `layout`.
 * Units: lengths in scene units, rebased to the render origin unless said; radiance in W/(m^2 sr) per channel
 * of linear Rec.709 (for glTF: nits); angles in radians.
 */
#ifndef TRIAD_TYPES_H
#define TRIAD_TYPES_H

#include "types/denoise.h"
#include "types/display.h"
#include "types/geometry.h"
#include "types/lights.h"
#include "types/materials.h"
#include "types/paths.h"
#include "types/picture.h"

#endif
