// Vertices and indices as meshoptimizer has them, in a document that is right: bytes for the mode, the
// filter, the stride and the number of elements, then the data.
#include "fuzz/targets/target.h"

using namespace triad::fuzz;

TRIAD_FUZZ_TARGET(meshopt) {
    if (input.size() < 5) return;
    constexpr const char *modes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"},
                         *filters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    const unsigned mode = input[0] % 3, stride = input[2], count = input[3];
    const std::string size = std::to_string(input.size() - 4), length = std::to_string(stride * count);
    const std::string accessor =
        mode == 0
            ? R"("componentType":5126,"type":"VEC3")"
            : R"("componentType":)" + std::string(stride == 2 ? "5123" : "5125") + R"(,"type":"SCALAR")";
    const std::string primitive =
        mode == 0 ? R"("attributes":{"POSITION":0})" : R"("attributes":{"POSITION":1},"indices":0)";
    const std::string elements = std::to_string(mode == 0 && stride < 12 ? 0 : count);
    load(file_of(
        glb_of(R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_meshopt_compression"],
"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" +
                   primitive + R"(}]}],"accessors":[{"bufferView":0,"count":)" + elements + "," + accessor +
                   R"(},{"count":256,"componentType":5126,"type":"VEC3"}],
"bufferViews":[{"buffer":1,"byteLength":)" +
                   length + (mode == 0 ? R"(,"byteStride":)" + std::to_string(stride) : "") +
                   R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":)" + size +
                   R"(,"byteStride":)" + std::to_string(stride) + R"(,"count":)" + std::to_string(count) +
                   R"(,"mode":")" + modes[mode] + R"(","filter":")" + filters[input[1] % 4] +
                   R"("}}}],"buffers":[{"byteLength":)" + size + R"(},{"byteLength":)" + length + "}]}",
               text_of(input.subspan(4)))));
}
