// Where float would do and where it would not: the numbers of docs/decisions/precision.md. Deterministic, no
// device.
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include "base/math.h"
#include "pack/pack.h"

namespace {

using namespace triad;

double relative(long double value, long double truth) { return double(std::fabs((value - truth) / truth)); }

/// Radiance of path i: mostly near 1, seldom a thousand times that (Pareto with exponent 2).
float radiance(std::uint64_t i) {
    std::uint64_t z = i * 0x9e3779b97f4a7c15ull + 0x1234567ull;  // splitmix64 (Steele et al. 2014)
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull, z = (z ^ (z >> 27)) * 0x94d049bb133111ebull, z ^= z >> 31;
    const double u = (double(z >> 11) + 0.5) * 0x1p-53;
    return float(0.5 / std::sqrt(u));
}

struct Sums {
    float plain = 0, high = 0, low = 0;
    double wide = 0;
    std::int64_t fixed = 0;
    long double truth = 0;

    void add(float x) {
        plain += x;
        const float y = x - low, t = high + y;  // Kahan 1965
        low = (t - high) - y, high = t;
        wide += double(x);
        fixed += std::int64_t(std::nearbyint(x * 0x1p20f));
        truth += x;
    }
};

void accumulation() {
    std::printf("Sum of N samples: relative error\n%12s %10s %14s %10s %16s\n", "N", "float", "float + Kahan",
                "double", "int64, 2^-20");
    Sums forward;
    std::uint64_t n = 0;
    for (const std::uint64_t end : {1000ull, 100'000ull, 10'000'000ull, 100'000'000ull}) {
        while (n < end) forward.add(radiance(n++));
        std::printf("%12llu %10.1e %14.1e %10.1e %16.1e\n", static_cast<unsigned long long>(end),
                    relative(forward.plain, forward.truth), relative(forward.high, forward.truth),
                    relative(forward.wide, forward.truth),
                    relative((long double)forward.fixed * 0x1p-20L, forward.truth));
    }
    Sums backward;
    while (n > 0) backward.add(radiance(--n));
    const auto same = [](bool yes) { return yes ? "same bits" : "other bits"; };
    std::printf("%12s %10s %14s %10s %16s\n\n", "backwards", same(forward.plain == backward.plain),
                same(forward.high == backward.high), same(forward.wide == backward.wide),
                same(forward.fixed == backward.fixed));
}

/// Shares of a million lights whose powers span six decades, picked from running sums.
void distributions() {
    constexpr std::size_t count = 1'000'000;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> decades(-3, 3);
    std::vector<double> powers(count);
    for (double& p : powers) p = std::pow(10.0, decades(random));
    const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
    const std::vector<std::uint32_t> ours = integer_cdf(powers);
    std::vector<float> sums(count + 1, 0.0f);
    for (std::size_t i = 0; i < count; ++i) sums[i + 1] = sums[i] + float(powers[i]);
    struct Row {
        std::size_t never = 0;
        double worst = 0;
    } in_float, in_integers;
    for (std::size_t i = 0; i < count; ++i) {
        const auto see = [&](Row& row, double share) {
            const double truth = powers[i] / total;
            row.never += share == 0;
            if (truth >= 1e-6) row.worst = std::max(row.worst, std::fabs(share / truth - 1));
        };
        see(in_float, double(sums[i + 1] - sums[i]) / double(sums[count]));
        see(in_integers, double(ours[i + 1] - ours[i]) / 4294967295.0);
    }
    std::printf("A million lights, powers over six decades, picked from running sums\n");
    std::printf("%-38s %18s %38s\n", "", "never picked", "worst share (of those from 1e-6 on)");
    for (const auto& [name, row] :
         {std::pair{"float", in_float}, {"double, then integers of 2^-32", in_integers}})
        std::printf("%-38s %18zu %37.2g%%\n", name, row.never, 100 * row.worst);
    std::printf("%-38s %18s %38s\n\n", "", "", "the density is read from the same integers");
}

/// A unit cube below five nodes whose translations reach `far`, seen from beside it: positions relative to
/// the camera.
template <class Matrix, class Vector>
Vector placed(double far, const dvec3& corner, const dvec3& camera) {
    using Scalar = typename Vector::value_type;
    Matrix m(Scalar(1));
    for (int level = 0; level < 5; ++level) {
        m = glm::translate(m, Vector(dvec3(far, 0.3 * far, -0.7 * far) * (level % 2 ? -0.45 : 0.5)));
        m = glm::rotate(m, Scalar(0.3 + level), glm::normalize(Vector(1, 2, 3)));
        m = glm::scale(m, Vector(Scalar(level % 2 ? 2.0 : 0.5)));
    }
    const auto p = m * glm::vec<4, Scalar>(Vector(corner), Scalar(1));
    return Vector(p) - Vector(camera);
}

void transforms() {
    using lvec3 = glm::vec<3, long double>;
    using lmat4 = glm::mat<4, 4, long double>;
    std::printf("A cube of 1 m below five nodes, relative to a camera 2 m away: greatest error in metres\n");
    std::printf("%12s %26s %40s\n", "distance, m", "float throughout", "double to the camera, then float");
    for (const double far : {1.0, 1e3, 1e6, 1e9}) {
        const dvec3 near_by = placed<dmat4, dvec3>(far, dvec3(0.5), dvec3(0.0));
        const dvec3 camera = glm::round(near_by) + dvec3(0, 0, 2);
        double in_float = 0, in_double = 0;
        for (int c = 0; c < 8; ++c) {
            const dvec3 corner(c & 1, (c >> 1) & 1, c >> 2);
            const lvec3 truth = placed<lmat4, lvec3>(far, corner, camera);
            in_float = std::max(
                in_float, double(glm::length(lvec3(placed<glm::mat4, vec3>(far, corner, camera)) - truth)));
            in_double =
                std::max(in_double,
                         double(glm::length(lvec3(vec3(placed<dmat4, dvec3>(far, corner, camera))) - truth)));
        }
        std::printf("%12.0e %26.1e %40.1e\n", far, in_float, in_double);
    }
    std::printf("\n");
}

/// Solid angle of a row of an equirectangular map: as a difference of cosines and as a product of sines.
void rows_of_a_map() {
    std::printf("Solid angle of the row at the pole of a map: relative error\n%12s %28s %28s\n", "rows",
                "float, cos a - cos b", "float, 2 sin sin");
    for (const unsigned rows : {256u, 4096u, 32768u}) {
        const long double b = 3.14159265358979323846L / rows;
        const long double truth = 2 * std::sin(b / 2) * std::sin(b / 2);
        const float fb = float(b);
        std::printf("%12u %28.1e %28.1e\n", rows, relative(1.0f - std::cos(fb), truth),
                    relative(2 * std::sin(fb / 2) * std::sin(fb / 2), truth));
    }
}

}  // namespace

int main() {
    accumulation();
    distributions();
    transforms();
    rows_of_a_map();
}
