// A mesh as Draco has it, in a document that is right.
#include "fuzz/targets/target.h"

using namespace triad::fuzz;

TRIAD_FUZZ_TARGET(draco) {
    const std::string size = std::to_string(input.size());
    load(file_of(glb_of(R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],
"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},
"indices":2,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0,"NORMAL":1}}}}]}],
"accessors":[{"componentType":5126,"count":3,"type":"VEC3"},{"componentType":5126,"count":3,"type":"VEC3"},
{"componentType":5121,"count":3,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":)" +
                            size + R"(}],"buffers":[{"byteLength":)" + size + "}]}",
                        text_of(input))));
}
