#pragma once
/// Triad as a library: renders glTF scenes and arrays by path tracing on OpenCL devices. docs/library.md
/// tells how to use it.
///
///     const triad::Film film = triad::render("scene.glb", {.width = 640, .height = 360, .spp = 64});
///     film.write("scene.png");
#include "triad/devices.h"
#include "triad/error.h"
#include "triad/film.h"
#include "triad/image.h"
#include "triad/options.h"
#include "triad/render.h"
#include "triad/scene.h"
