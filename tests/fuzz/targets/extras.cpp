// extras.triad of a material and of a light, in a document that is right.
#include "fuzz/targets/target.h"

using namespace triad::fuzz;

TRIAD_FUZZ_TARGET(extras) {
    const std::string extras = R"("extras":{"triad":)" + std::string(text_of(input)) + "}";
    load(file_of(glb_of(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}],"extensionsUsed":["KHR_lights_punctual"],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}],
"materials":[{"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},
"KHR_materials_volume":{"thicknessFactor":1}},)" +
                            extras + R"(}],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point",)" +
                            extras + "}]}}}",
                        std::string(36, '\x3f'))));
}
