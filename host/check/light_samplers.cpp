// What light sampling draws: lights by their shares, directions of the environment by their densities.
#include <bit>
#include <numeric>
#include <tuple>

#include "check/cases.h"
#include "check/kernels.h"
#include "check/picture.h"
#include "pack/pack.h"

namespace triad {
namespace {

using namespace picture_case;

PackedScene packed_under(EnvironmentMap map) {
    Builder b;
    b.add(shapes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), lambert(0.5f));
    b.scene.environment = std::move(map);
    validate(b.scene);
    return pack(b.scene, RenderSettings{});
}

/// Prime sizes, a black half, noise, and a sun: what a tree over rows and columns gets wrong first.
EnvironmentMap hard_map(unsigned width, unsigned height, float sun) {
    EnvironmentMap map{width, height, std::vector<float>(std::size_t(width) * height * 3)};
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                map.rgb[(std::size_t(y) * width + x) * 3 + c] =
                    y > height / 2 ? 0.0f : 0.05f + 0.01f * float((x * 7919 + y * 104729) % 101);
    for (int c = 0; c < 3; ++c) map.rgb[(std::size_t(height / 3) * width + width - 1) * 3 + c] = sun;
    return map;
}

double solid_angle(unsigned row, unsigned width, unsigned height) {
    return 2 * pi / width * (std::cos(pi * row / height) - std::cos(pi * (row + 1) / height));
}

/// Shares of the cells as the texels' densities say them.
std::vector<double> shares_of(const PackedScene& packed) {
    const dev::Environment& e = packed.environment;
    const std::size_t words = e.format == ENVIRONMENT_FLOAT ? 4 : 2;
    std::vector<double> shares(std::size_t(e.width) * e.height);
    for (std::size_t i = 0; i < shares.size(); ++i)
        shares[i] = double(std::bit_cast<float>(packed.surfaces->env_texels[i * words + words - 1])) *
                    solid_angle(unsigned(i / e.width), e.width, e.height);
    return shares;
}

void densities_integrate_to_one(Check& check) {
    for (const auto& [width, height, sun] :
         {std::tuple{53u, 29u, 1e7f}, {7u, 3u, 1.0f}, {1u, 1u, 1.0f}, {1100u, 40u, 20.0f}}) {
        const PackedScene packed = packed_under(hard_map(width, height, sun));
        const std::vector<double> shares = shares_of(packed);
        check.near(std::accumulate(shares.begin(), shares.end(), 0.0), 1.0, 1e-5,
                   "integral of the density, width ", width);
    }
}

void cells_by_their_density(Check& check) {
    for (const auto& [width, height, sun] :
         {std::tuple{53u, 29u, 20.0f}, {33u, 7u, 1e7f}, {1100u, 4u, 5.0f}}) {
        const PackedScene packed = packed_under(hard_map(width, height, sun));
        const std::size_t count = check.count(1 << 20);
        const auto drawn = draw_lights(check, packed, R"(
    const Environment e = scene.frame->environment;
    Vec2 uv;
    const Vec3 d = environment_sample(&scene, &e, u.set[0], &uv);
    const Vec2 back = environment_uv(&e, d);
    w = vec4_make(uv.x, uv.y, fabs(back.x - uv.x), fabs(back.y - uv.y));
)",
                                       count);
        const std::vector<double> shares = shares_of(packed);
        std::vector<double> counts(shares.size()), expected(shares.size());
        double off = 0;
        for (const auto& d : drawn) {
            check.holds(d[0] >= 0 && d[0] < 1 && d[1] >= 0 && d[1] <= 1, "map coordinates ", d[0], " ", d[1]);
            // A cell's border belongs to either side as far as floats can tell.
            if (!(d[0] >= 0 && d[1] >= 0)) continue;
            const auto column = std::min(unsigned(double(d[0]) * width + 1e-6), width - 1);
            const auto row = std::min(unsigned(double(d[1]) * height), height - 1);
            counts[std::size_t(row) * width + column] += 1;
            off = std::max(off, double(std::min(d[2], 1 - d[2])) * (d[1] > 0.01 && d[1] < 0.99));
            off = std::max(off, double(d[3]));
        }
        for (std::size_t i = 0; i < shares.size(); ++i) expected[i] = shares[i] * double(count);
        check.at_most(chi_square_z(counts, expected), chi_square_limit, "chi-square, width ", width);
        check.also_at_most(off, 2e-5, "direction and map coordinates must name the same point");
    }
}

void column_of_every_share(Check& check) {
    // Every 16-bit share of one row: as many draws of a column as its bounds say, at every depth of the tree.
    for (const unsigned width : {1u, 31u, 32u, 33u, 1024u, 1025u, 5000u}) {
        const EnvironmentMap map = hard_map(width, 1, 3.0f);
        const PackedScene packed = packed_under(map);
        const auto found = draw_lights(check, packed, R"(
    const uint column = columns_descend(&scene, 0u, i << 16, scene.frame->environment.columns.levels);
    w = vec4_make((float)column, 0.0f, 0.0f, 0.0f);
)",
                                       1 << 16);
        const auto texel = [&](unsigned x) { return double(map.rgb[std::size_t(x % width) * 3]); };
        std::vector<double> weights(width);
        for (unsigned x = 0; x < width; ++x)
            weights[x] = (texel(x + width - 1) + 6 * texel(x) + texel(x + 1)) / 8;
        const std::vector<std::uint32_t> bounds = column_shares(weights);
        for (std::uint32_t share = 0; share < 65536; ++share) {
            const auto column = std::upper_bound(bounds.begin(), bounds.end(), share) - bounds.begin() - 1;
            check.equal(found[share][0], float(column), "share ", share, " of ", width, " columns");
        }
    }
}

void light_picks(Check& check) {
    Builder b;
    b.add(shapes::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), lambert(0.5f));
    for (int i = 0; i < 700; ++i)  // from afar: they are in no tree
        b.scene.lights.push_back(
            {.type = PunctualLight::Type::directional, .colour = vec3(float(i % 13) * 0.1f)});
    validate(b.scene);
    const PackedScene packed = pack(b.scene, RenderSettings{});
    const std::size_t count = check.count(1 << 20);
    const auto drawn = draw_lights(check, packed, R"(
    float fraction, probability;
    const uint k = cdf_find(&scene.frame->lights, scene.light_cdf, u.set[2].x, &fraction, &probability);
    w = vec4_make((float)k, fabs(probability - scene.lights[k].pick), fraction, 0.0f);
)",
                                   count);
    std::vector<double> counts(packed.lights.size()), expected(packed.lights.size());
    for (const auto& d : drawn) {
        check.also_at_most(d[0], double(counts.size() - 1), "light");
        if (!(d[0] < float(counts.size()))) continue;
        check.also_at_most(d[1], 1e-9, "probability of the pick");
        check.holds(d[2] >= 0 && d[2] < 1, "fraction ", d[2]);
        counts[std::size_t(d[0])] += 1;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        expected[i] = double(packed.lights[i].pick) * double(count);
        if (packed.lights[i].pick == 0) {
            check.equal(counts[i], 0, "a light without power was picked");
        }
    }
    check.at_most(chi_square_z(counts, expected), chi_square_limit, "chi-square of picks");
}

void environment_by_facing(Check& check) {
    constexpr std::size_t patches = PATCHES * PATCHES;
    for (const bool even : {false, true}) {
        const PackedScene packed = packed_under(
            even ? EnvironmentMap{32, 16, std::vector<float>(32 * 16 * 3, 1.0f)} : hard_map(1100, 40, 20.0f));
        const std::size_t count = check.count(1 << 20);
        const auto drawn = draw_lights(check, packed, R"(
    const Environment e = scene.frame->environment;
    const float k = (float)(i & 7u);
    const Vec3 n = sampling_sphere(vec2_make(0.0625f + 0.125f * k, 0.05f + 0.12f * k));
    const uint facing = facing_of(n);
    float factor;
    Vec2 uv;
    const UVec2 warped = facing_warp(&scene, facing, u.set[0], &factor);
    const Vec3 d = environment_sample(&scene, &e, warped, &uv);
    const uint patch = (warped.y >> (32u - PATCH_BITS)) * PATCHES + (warped.x >> (32u - PATCH_BITS));
    w = vec4_make(factor, facing_found(&scene, facing, d, uv), vec3_dot(n, d),
                  (float)((facing - 1u) * PATCHES * PATCHES + patch));
)",
                                       count);
        std::vector<double> counts(FACINGS * FACINGS * patches), expected(counts.size());
        std::vector<double> of_facing(FACINGS * FACINGS);
        double below = 0, differ = 0;
        for (const auto& d : drawn) {
            check.also_at_most(d[3], double(counts.size() - 1), "facing and patch");
            if (!(d[3] >= 0 && d[3] < float(counts.size()))) continue;
            counts[std::size_t(d[3])] += 1, of_facing[std::size_t(d[3]) / patches] += 1;
            below += d[2] < 0;
            differ += !(std::abs(d[1] - d[0]) <= 1e-5f * d[0]);
        }
        const std::uint16_t* facings = packed.surfaces->env_columns.data() + packed.environment.columns.size;
        const auto share = [&](std::size_t first, std::size_t i) {
            return (facings[first + i] + 1.0 - (i == 0 ? 0.0 : facings[first + i - 1] + 1.0)) / 65536;
        };
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const std::size_t first = i / patches * FACING_SHARES, row = i % patches / PATCHES;
            expected[i] = of_facing[i / patches] * share(first, row) *
                          share(first + PATCHES + row * PATCHES, i % PATCHES);
        }
        check.at_most(chi_square_z(counts, expected), chi_square_limit, "chi-square, map ", even);
        // A patch's border belongs to either side as far as floats can tell.
        check.at_most(differ / double(count), 2e-3, "factors that differ, map ", even);
        // Half of them, were it not for facings.
        if (even) check.at_most(below / double(count), 0.1, "directions from behind");
    }
}

}  // namespace

void add_light_samplers(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(
        cases.end(),
        {
            {"C16", "chi-square of the environment with a sun", quick, cells_by_their_density},
            {"C16c", "densities of the environment integrate to 1", quick, densities_integrate_to_one},
            {"C16d", "every share finds its column", standard, column_of_every_share},
            {"C16g", "the environment for where a surface faces", quick, environment_by_facing},
            {"S6", "chi-square of light picks", standard, light_picks},
        });
}

}  // namespace triad
