#pragma once
/// What the programs of a capture were made for.
#include "device/recording.h"
#include "trace/node_format.h"
#include "trace/path_driver.h"

namespace triad {

BvhFormat captured_format(const Recording& work);
PathDriverKind captured_driver(const Recording& work);

}  // namespace triad
