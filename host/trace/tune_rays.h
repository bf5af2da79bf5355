#pragma once
/// The workload of the search `rays`: intersect_closest over incoherent rays inside a bumpy sphere.
#include "trace/tune.h"

namespace triad {

std::unique_ptr<Workload> make_ray_workload(Device& device);

}  // namespace triad
