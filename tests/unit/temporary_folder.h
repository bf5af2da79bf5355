#pragma once
/// A folder of its own for a test, gone afterwards.
#include "base/temporary_folder.h"

using triad::TemporaryFolder;
