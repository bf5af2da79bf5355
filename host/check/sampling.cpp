// Frames and the maps from the unit square to the shapes that are sampled.
#include <cmath>
#include <functional>
#include <random>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/measurements.h"

namespace triad {
namespace {

using Vector = std::array<float, 4>;  // float4

std::vector<Vector> unit_vectors(std::size_t count) {
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    std::vector<Vector> vectors;
    for (std::size_t i = 0; i < count; ++i) {
        dvec3 v(normal(generator), normal(generator), normal(generator));
        // a quarter near +z and -z each, where the naive construction breaks
        if (i % 4 < 2) v = dvec3(v.x * std::pow(10.0, -double(i % 23) / 2), v.y * 1e-4, i % 4 ? 1 : -1);
        v = glm::normalize(v);
        vectors.push_back({float(v.x), float(v.y), float(v.z), 0});
    }
    vectors[0] = {0, 0, -1, 0}, vectors[1] = {0, 0, 1, 0}, vectors[2] = {1, 0, 0, 0},
    vectors[3] = {0, -1, -0.0f, 0};
    return vectors;
}

void frames_are_orthonormal(Check& check) {
    const char* const source = R"(#include "common/frame.h"
__kernel void frames(__global Vec4* out, __global const Vec4* normals, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const ShadingFrame f = frame_make(vec4_xyz(normals[i]));
    out[4 * i] = vec3_with(f.x, 0.0f);
    out[4 * i + 1] = vec3_with(f.y, 0.0f);
    out[4 * i + 2] = vec3_with(f.z, 0.0f);
    const Vec3 v = vec3_make(0.36f, -0.48f, 0.8f);
    out[4 * i + 3] = vec3_with(vec3_sub(frame_to_local(&f, frame_to_world(&f, v)), v), 0.0f);
}
)";
    const auto normals = unit_vectors(check.count(1 << 18));
    const auto rows = run_kernel<Vector>(check.device, source, "frames",
                                         Arguments().add(check.device.upload(normals)), normals.size(), 4);
    const auto at = [&](std::size_t i) { return dvec3(rows[i][0], rows[i][1], rows[i][2]); };
    double worst = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const dvec3 x = at(4 * i), y = at(4 * i + 1), z = at(4 * i + 2);
        for (double error :
             {glm::dot(x, y), glm::dot(y, z), glm::dot(z, x), glm::dot(x, x) - 1, glm::dot(y, y) - 1,
              glm::dot(glm::cross(x, y), z) - 1, glm::length(at(4 * i + 3))})
            worst = std::max(worst, std::abs(error));
    }
    check.at_most(worst, 1e-6);
}

/// Draws points with `expression` of (Vec2 u) giving (cell u, cell v, error) and checks the counts of
/// up to 32 x 32 cells against `share`, by default the same for each.
void expect_distribution(
    Check& check, const std::string& expression,
    const std::function<double(int, int, int)>& share = [](int, int, int n) { return 1.0 / (n * n); }) {
    const std::string source = R"(#include "common/random.h"
#include "common/sampling.h"
__kernel void draw(__global Vec4* out, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Sampler s = sampler_make(0u, i, 0u, 0u, 5u);
    const Vec2 u = sampler_2d(&s, SAMPLER_SOBOL_SETS);
    Vec3 w;
    )" + expression + R"(
    out[i] = vec3_with(w, 0.0f);
}
)";
    const std::size_t count = check.count(1 << 18);
    const int n = grid_edge(count, 32);
    const auto points = run_kernel<Vector>(check.device, source, "draw", {}, count);
    std::vector<double> counts(n * n), expected(n * n);
    for (const Vector& p : points) {
        check.holds(p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1, expression, p[0], " ", p[1]);
        check.also_at_most(std::abs(p[2]), 1e-6, expression);
        ++counts[std::min(n - 1, int(p[0] * n)) * n + std::min(n - 1, int(p[1] * n))];
    }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) expected[i * n + j] = double(count) * share(i, j, n);
    check.below(chi_square_z(counts, expected), chi_square_limit, expression);
}

const std::string turn = "math_saturate(0.5f + math_atan2(w.y, w.x) / MATH_TWO_PI)";
const std::string length_error = "vec3_dot(w, w) - 1.0f";

void disc_is_uniform(Check& check) {
    expect_distribution(check,
                        "Vec2 d = sampling_disc(u); w = vec3_make(d.x, d.y, 0.0f);"
                        "w = vec3_make(math_min(vec3_dot(w, w), 1.0f)," +
                            turn + ", 0.0f);");
}

void hemisphere_is_cosine_weighted(Check& check) {
    // the pdf is z / pi: z^2 is uniform
    expect_distribution(
        check, "w = sampling_cosine(u); w = vec3_make(w.z * w.z, " + turn + ", " + length_error + ");");
}

void triangle_is_uniform(Check& check) {
    // share of the cell (i, j) of the unit square that lies below the diagonal
    expect_distribution(check, "Vec2 d = sampling_triangle(u); w = vec3_make(d.x, d.y, 0.0f);",
                        [](int i, int j, int n) {
                            return (i + j < n - 1 ? 2.0 : i + j == n - 1 ? 1.0 : 0.0) / (n * n);
                        });
}

void sphere_is_uniform(Check& check) {
    expect_distribution(check, "w = sampling_sphere(u); w = vec3_make(0.5f - 0.5f * w.z, " + turn + ", " +
                                   length_error + ");");
}

void cones_are_uniform(Check& check) {
    // sin^2 / (1 + cos) of the direction over that of the cone is uniform
    for (const char* sin2 : {"1.0f", "0.25f", "1e-4f", "1e-10f"})
        expect_distribution(
            check,
            std::string("float m = sampling_one_minus_cos(") + sin2 +
                "); w = sampling_cone(u, m); float t = sampling_one_minus_cos(w.x * w.x + w.y * w.y) / m;"
                "w = vec3_make(math_min(t, 1.0f), " +
                turn + ", " + length_error + ");");
}

void solid_angles_of_small_cones(Check& check) {
    // C13: sphere of radius r at distance 1, r = 1 .. 1e-6
    const char* const source = R"(#include "common/sampling.h"
__kernel void omega(__global float* out, __global const float* r, uint count) {
    const uint i = get_global_id(0);
    if (i < count) out[i] = 1.0f / sampling_cone_pdf(sampling_one_minus_cos(r[i] * r[i]));
}
)";
    std::vector<float> radii;
    for (float r = 1; r > 1e-6f; r *= 0.9f) radii.push_back(r);
    const auto omega = run_kernel<float>(check.device, source, "omega",
                                         Arguments().add(check.device.upload(radii)), radii.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const double half = std::sin(0.5 * std::asin(double(radii[i])));
        check.near(omega[i] / (4 * pi * half * half), 1, 1e-6, "solid angle at radius ", radii[i]);
    }
}

void numbers_that_have_chosen(Check& check) {
    const char* const source = R"(#include "common/sampling.h"
__kernel void choose(__global Vec2* out, __global const Vec2* cases, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    float u = cases[i].x;
    const uint chosen = sampling_choose(&u, cases[i].y);
    out[i] = vec2_make((float)chosen, u);
}
)";
    using Two = std::array<float, 2>;
    const float end = 1 - 0x1p-24f;
    std::vector<Two> cases;  // number, probability
    for (const float p : {0.0f, 1e-6f, 0.04f, 0.5f, 0.7f, end, 1.0f}) {
        std::vector<float> numbers{0.0f, 0.3f, end};
        for (int beside = -1; beside <= 2; ++beside)  // numbers have 24 bits
            numbers.push_back((std::floor(p * 0x1p24f) + float(beside)) * 0x1p-24f);
        for (const float u : numbers)
            if (u >= 0 && u < 1) cases.push_back({u, p});
    }
    const auto found = run_kernel<Two>(check.device, source, "choose",
                                       Arguments().add(check.device.upload(cases)), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto [u, p] = cases[i];
        const double within = u < p ? double(u) / p : (double(u) - p) / (1.0 - p);
        check.equal(found[i][0], u < p ? 1.0f : 0.0f, "choice of ", u, " at ", p);
        check.holds(found[i][1] >= 0 && found[i][1] < 1, "no number below 1 is left of ", u, " at ", p);
        check.near(found[i][1], within, p == 0 || p == 1 ? 0.0 : 1e-6, "what is left of ", u, " at ", p);
    }
}

}  // namespace

void add_sampling(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(),
                 {
                     {"C13", "solid angles of small cones", quick, solid_angles_of_small_cones},
                     {"C22", "orthonormal frames", quick, frames_are_orthonormal},
                     {"S1", "chi-square of the disc", standard, disc_is_uniform},
                     {"S2", "chi-square of the cosine hemisphere", quick, hemisphere_is_cosine_weighted},
                     {"S3", "chi-square of the triangle", quick, triangle_is_uniform},
                     {"S4", "chi-square of the sphere", standard, sphere_is_uniform},
                     {"S5", "chi-square of cones", standard, cones_are_uniform},
                     {"S9", "numbers that have chosen", quick, numbers_that_have_chosen},
                 });
}

}  // namespace triad
