#pragma once
/// The workload of the search `paths`: samples of two small generated rooms, without and with glass that
/// disperses. What suits the one may be several times slower for the other, and a device follows all its
/// paths one way.
#include "trace/tune.h"

namespace triad {

std::unique_ptr<Workload> make_path_workload(Device& device);

}  // namespace triad
