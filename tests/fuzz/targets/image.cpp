// A picture of any format: as a texture, as an environment, and as one to compare or to resolve.
#include <vector>

#include "fuzz/targets/target.h"
#include "io/io.h"

using namespace triad;

TRIAD_FUZZ_TARGET(image) {
    const auto path = fuzz::file_of(input);
    fuzz::answer([](fuzz::Input bytes) { decode_image("a texture", {bytes.begin(), bytes.end()}); }, input);
    fuzz::answer([](fuzz::Input bytes) { load_environment(fuzz::file_of(bytes)); }, input);
    read_picture(path);
}
