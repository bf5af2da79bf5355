// The film's sums and counters.
#include "check/cases.h"
#include "check/kernels.h"
#include "check/measurements.h"
#include "kernels/types.h"

namespace triad {
namespace {

const char* const film_sums_source = R"(#include "common/film.h"
TRIAD_FUNCTION float value_of(uint i) { return 0.7f + convert_float(i % 1000u) * 0.001f; }
/* Each item adds `each` of the known values. */
__kernel void accumulate(__global long* out, uint each, uint count) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    long sum = 0;
    uint saturated = 0u;
    for (uint k = 0u; k < each; ++k) sum = add_sat(sum, film_fixed(value_of(item * each + k), 0x1p20f, &saturated));
    out[item] = saturated ? -1 : sum;
}
__kernel void values(__global float* out, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[i] = value_of(i);
}
/* Numbers as the film keeps them: (high, low, saturated). */
__kernel void fix(__global int4* out, __global const float* x, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    uint saturated = 0u;
    const long q = film_fixed(x[i], 0x1p20f, &saturated);
    out[i] = (int4)((int)(q >> 32), (int)q, (int)saturated, 0);
}
__kernel void tally(__global uint* unused, volatile __global uint* counters, uint each, uint count) {
    if (get_global_id(0) >= count) return;
    for (uint k = 0u; k < each; ++k) counter_add(counters, 1u, 0x00300001u);
}
)";

void accumulation(Check& check) {
    const std::size_t total = check.count(100'000'000, 1'000'000), items = check.count(1 << 16);
    const auto each = std::uint32_t(total / items);
    const auto sums =
        run_kernel<std::int64_t>(check.device, film_sums_source, "accumulate", Arguments().add(each), items);
    const auto values = run_kernel<float>(check.device, film_sums_source, "values", {}, 1000);
    double period = 0, expected = 0;
    for (float v : values) period += v;
    const std::uint64_t n = std::uint64_t(each) * items;
    expected = period * double(n / 1000);
    for (std::uint64_t i = 0; i < n % 1000; ++i) expected += values[i];
    std::int64_t sum = 0;
    for (std::int64_t s : sums) check.holds(s > 0, "a sum saturates"), sum += s;
    check.near(std::ldexp(double(sum), -20) / expected, 1, 1e-6, "sum of ", n, " values over the exact one");
}

void fixed_point(Check& check) {
    // Rounded to nearest even; what does not fit is cut and counted.
    const std::vector<float> x{0.0f,    1.0f,     -1.0f,   0x1.8p-20f, 0x1.4p-19f,
                               0x1p41f, -0x1p41f, 0x1p42f, -0x1p43f,   3e38f};
    const std::vector<std::int64_t> expected{0,
                                             1 << 20,
                                             -(1 << 20),
                                             2,
                                             2,
                                             std::int64_t(1) << 61,
                                             -(std::int64_t(1) << 61),
                                             std::int64_t(1) << 62,
                                             -(std::int64_t(1) << 62),
                                             std::int64_t(1) << 62};
    const auto rows = run_kernel<std::array<std::int32_t, 4>>(
        check.device, film_sums_source, "fix", Arguments().add(check.device.upload(x)), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::int64_t q = std::int64_t(rows[i][0]) * (std::int64_t(1) << 32) + std::uint32_t(rows[i][1]);
        check.equal(q, expected[i], "fixed point of ", x[i]);
        check.equal(rows[i][2], i >= 7 ? 1 : 0, "saturation of ", x[i]);
    }
}

void counters(Check& check) {
    // Every item adds many times to one counter: an addition that is lost, or a carry, is a wrong total.
    const std::size_t items = check.level == CheckLevel::tiny ? 256 : 1 << 14;
    const std::uint32_t each = check.level == CheckLevel::tiny ? 4 : 512;
    Device& device = check.device;
    const Buffer counters = device.upload(std::vector<std::uint32_t>(2 * COUNTERS));
    run_kernel<std::uint32_t>(device, film_sums_source, "tally", Arguments().add(counters).add(each), items);
    const auto words = device.download<std::uint32_t>(counters);
    check.equal(words[2] | std::uint64_t(words[3]) << 32, std::uint64_t(items) * each * 0x00300001u, "total");
    check.equal(words[0] + words[1] + words[4] + words[5], 0u, "a neighbouring counter");
}

}  // namespace

void add_film(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(), {
                                  {"C17", "accumulation of known values", quick, accumulation},
                                  {"C17b", "fixed point rounds, cuts and counts", quick, fixed_point},
                                  {"R1", "counters lose no addition", quick, counters},
                              });
}

}  // namespace triad
