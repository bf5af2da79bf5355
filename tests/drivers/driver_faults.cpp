// Faults of drivers that shaped the kernels (docs/testing.md), each as a kernel of a few lines with the
// answer that OpenCL asks for. Says which of them the device has; ends with 1 when there is one.
// TRIAD_TEST_DEVICE chooses the device.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "device/device.h"

namespace {

struct Fault {
    const char* what;
    const char* function;  ///< float4 answer(float4): 2 x, 2 y, 2 z, x
};

const Fault faults[] = {
    {"float3 as parameter and result of a function that is called (Intel's vectoriser)",
     "__attribute__((noinline)) static float3 twice(float3 v) { return v + v; }\n"
     "static float4 answer(float4 a) { return (float4)(twice(a.xyz), a.x); }\n"},
    {"float3 as a parameter (Intel's vectoriser)",
     "__attribute__((noinline)) static float4 twice(float3 v) { return (float4)(v + v, v.x); }\n"
     "static float4 answer(float4 a) { return twice(a.xyz); }\n"},
    {"float3 as a result (Intel's vectoriser)",
     "__attribute__((noinline)) static float3 twice(float4 v) { return v.xyz + v.xyz; }\n"
     "static float4 answer(float4 a) { return (float4)(twice(a), a.x); }\n"},
    {"float4 as parameter and result",
     "__attribute__((noinline)) static float4 twice(float4 v) { return (float4)(v.xyz + v.xyz, v.x); }\n"
     "static float4 answer(float4 a) { return twice(a); }\n"},
    {"a struct of three floats as parameter and result",
     "typedef struct { float x, y, z; } Three;\n"
     "__attribute__((noinline)) static Three twice(Three v) {\n"
     "    Three r = {v.x + v.x, v.y + v.y, v.z + v.z}; return r; }\n"
     "static float4 answer(float4 a) { Three t = {a.x, a.y, a.z}, r = twice(t); return (float4)(r.x, r.y, "
     "r.z, t.x); }\n"},
    {"a struct that a function takes by value and changes (Mesa 22.3.6)",
     "typedef struct { float x, y, z; } Three;\n"
     "__attribute__((noinline)) static float4 twice(Three v) {\n"
     "    v.x += v.x, v.y += v.y, v.z += v.z; return (float4)(v.x, v.y, v.z, 0.0f); }\n"
     "static float4 answer(float4 a) { Three t = {a.x, a.y, a.z}; float4 r = twice(t); r.w = t.x; return r; "
     "}\n"},
};

}  // namespace

int main() {
    try {
        const char* selector = std::getenv("TRIAD_TEST_DEVICE");
        triad::Device device = triad::Device::open({.selector = selector ? selector : ""});
        std::printf("%s, %s\n", device.info().name.c_str(), device.info().driver.c_str());
        constexpr std::size_t count = 256;
        std::vector<float> in(4 * count);
        for (std::size_t i = 0; i < in.size(); ++i) in[i] = float(i + 1);
        bool any = false;
        for (const Fault& fault : faults) {
            const triad::Program program = device.build_source(
                "fault.cl", std::string(fault.function) +
                                "__kernel void fault(__global float4* out, __global const float4* in) {\n"
                                "    const size_t i = get_global_id(0);\n    out[i] = answer(in[i]);\n}\n");
            const triad::Buffer out = device.allocate(in.size() * sizeof(float));
            device.run(program.kernel("fault"), triad::Arguments().add(out).add(device.upload(in)), count);
            const auto found = device.download<float>(out);
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const float *a = &in[4 * i], *f = &found[4 * i];
                wrong += f[0] != 2 * a[0] || f[1] != 2 * a[1] || f[2] != 2 * a[2] || f[3] != a[0];
            }
            std::printf("%3zu of %zu wrong: %s\n", wrong, count, fault.what);
            any = any || wrong > 0;
        }
        return any ? 1 : 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "driver_faults: %s\n", error.what());
        return 3;
    }
}
