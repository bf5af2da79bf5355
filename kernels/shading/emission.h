/* Where photons start: a light by its share, a point on it, and a direction to one of the casters, the
 * spheres around what reflects or refracts without blur. Every direction that hits some caster can be drawn,
 * so that aiming biases nothing; the density is that of the mixture over all casters (Veach 1997,
 * section 9.2.1, the one-sample model with the balance heuristic: weights by solid angle make the mixture
 * uniform where casters do not overlap). */
#ifndef TRIAD_SHADING_EMISSION_H
#define TRIAD_SHADING_EMISSION_H

#include "common/frame.h"
#include "common/sampling.h"
#include "shading/light.h"

typedef struct PhotonSource {
    Ray ray;
    Vec3 power;    /* flux in W over the density of everything that was drawn; black: no photon */
    float range;   /* punctual light: where it ends; 0: nowhere */
    uint spectrum; /* of the light: power is its tint, still to be multiplied by what spectrum.h says */
} PhotonSource;

/* The cone of directions from p that hit a caster: squared sine of its half angle (more than 1: p is inside,
 * and every direction hits) and solid angle / 2 pi. */
TRIAD_FUNCTION float photon_cone(global const Caster* caster, Vec3 p, Vec3* axis, float* sin2) {
    *axis = vec3_sub(VEC3_OF(caster->centre), p);
    const float distance2 = vec3_dot(*axis, *axis);
    const float radius2 = caster->radius * caster->radius;
    if (!(distance2 > radius2)) {
        *sin2 = 2.0f;
        return 2.0f;
    }
    *axis = vec3_scale(*axis, 1.0f / sqrt(distance2));
    *sin2 = radius2 / distance2;
    return sampling_one_minus_cos(*sin2);
}

/* A direction from p to one of the casters; pick and u in [0, 1). Returns 1 / density in solid angle. */
TRIAD_FUNCTION float photon_aim(global const Caster* casters, uint count, Vec3 p, float pick, Vec2 u,
                                Vec3* direction) {
    float total = 0.0f, sin2;
    Vec3 axis;
    for (uint i = 0u; i < count; ++i) total += photon_cone(casters + i, p, &axis, &sin2);
    float left = pick * total;
    uint chosen = 0u;
    for (; chosen + 1u < count; ++chosen) {
        const float share = photon_cone(casters + chosen, p, &axis, &sin2);
        if (left < share) break;
        left -= share;
    }
    const float share = photon_cone(casters + chosen, p, &axis, &sin2);
    if (sin2 > 1.0f) {
        *direction = sampling_sphere(u);
    } else {
        const ShadingFrame frame = frame_make(axis);
        *direction = vec3_normalize(frame_to_world(&frame, sampling_cone(u, share)));
    }
    uint hits = 1u;
    for (uint i = 0u; i < count; ++i) {
        if (i == chosen) continue;
        photon_cone(casters + i, p, &axis, &sin2);
        const Vec3 off = vec3_cross(axis, *direction);
        hits += sin2 > 1.0f || (vec3_dot(axis, *direction) > 0.0f && vec3_dot(off, off) <= sin2);
    }
    return 2.0f * MATH_PI * total / (float)hits;
}

/* A direction from a light on the spot that is aimed at nothing: by the cosine, within the cone of a spot, or
 * anywhere. Returns 1 / density in solid angle. */
TRIAD_FUNCTION float photon_aimless(const Light* light, Vec3 axis, float pick, Vec2 u, Vec3* direction) {
    const ShadingFrame frame = frame_make(axis);
    if (light->type == LIGHT_TRIANGLE) {
        const Vec3 d = sampling_cosine(u);
        const int both = (light->flags & MATERIAL_DOUBLE_SIDED) != 0u;
        *direction = frame_to_world(&frame, vec3_make(d.x, d.y, both && pick < 0.5f ? -d.z : d.z));
        return d.z > 0.0f ? (both ? 2.0f : 1.0f) * MATH_PI / d.z : 0.0f;
    }
    if (light->type == LIGHT_SPOT) {
        const float one_minus_cos = 1.0f + light->cone_offset / light->cone_scale;
        *direction = frame_to_world(&frame, sampling_cone(u, one_minus_cos));
        return 2.0f * MATH_PI * one_minus_cos;
    }
    *direction = sampling_sphere(u);
    return 4.0f * MATH_PI;
}

/* A ray along `direction` through the disc that one of the casters shows to it; without casters, through the
 * one that the scene shows. Returns 1 / density per area across the direction. */
TRIAD_FUNCTION float photon_aim_from_afar(global const PhotonFrame* f, global const Caster* casters,
                                          Vec3 direction, float pick, Vec2 u, Vec3* origin) {
    const Vec3 centre = VEC3_OF(f->scene_centre);
    const ShadingFrame frame = frame_make(direction);
    if (f->casters == 0u) {
        const Vec2 d = vec2_scale(sampling_disc(u), f->scene_radius);
        const Vec3 through = vec3_add_scaled(vec3_add_scaled(centre, frame.x, d.x), frame.y, d.y);
        *origin = vec3_add_scaled(through, direction, -1.01f * f->scene_radius);
        return MATH_PI * math_square(f->scene_radius);
    }
    float total = 0.0f;
    for (uint i = 0u; i < f->casters; ++i) total += math_square(casters[i].radius);
    float left = pick * total;
    uint chosen = 0u;
    for (; chosen + 1u < f->casters; ++chosen) {
        const float share = math_square(casters[chosen].radius);
        if (left < share) break;
        left -= share;
    }
    const Vec2 d = vec2_scale(sampling_disc(u), casters[chosen].radius);
    const Vec3 through =
        vec3_add_scaled(vec3_add_scaled(VEC3_OF(casters[chosen].centre), frame.x, d.x), frame.y, d.y);
    uint hits = 1u;
    for (uint i = 0u; i < f->casters; ++i) {
        const Vec3 to = vec3_sub(VEC3_OF(casters[i].centre), through);
        const Vec3 off = vec3_cross(to, direction);
        hits += i != chosen && vec3_dot(off, off) <= math_square(casters[i].radius);
    }
    const float back = vec3_dot(vec3_sub(through, centre), direction) + 1.01f * f->scene_radius;
    *origin = vec3_add_scaled(through, direction, -back);
    return MATH_PI * total / (float)hits;
}

/* Photon with the random numbers u of block 0: (point, aim, direction, choice of light and caster). */
TRIAD_FUNCTION PhotonSource photon_emit(const Scene* scene, global const PhotonFrame* f,
                                        global const uint* light_tree, global const Caster* casters,
                                        const SamplerBlock* u) {
    PhotonSource s;
    s.power = vec3_splat(0.0f);
    s.range = 0.0f;
    s.ray.t_max = INFINITY;
    s.ray.skip_instance = s.ray.skip_primitive = TRIAD_NONE;
    float within, probability;
    const uint index = cdf_find(&f->lights, light_tree, u->set[3].x, &within, &probability);
    const Light light = scene->lights[index];
    s.spectrum = light.flags >> LIGHT_SPECTRUM_SHIFT;
    const float pick = random_float(u->set[3].y);
    const Vec2 on_light = random_point(u->set[0]), aim = random_point(u->set[1]);
    const Vec3 colour = VEC3_OF(light.colour);
    const Vec3 axis = VEC3_OF(light.axis);
    Vec3 origin = VEC3_OF(light.position), direction = axis;
    (void)on_light, (void)colour, (void)pick, (void)aim;
#if TRIAD_TRIANGLE_LIGHTS
    if (light.type == LIGHT_TRIANGLE) {
        const Vec2 b = sampling_triangle(on_light);
        const Vec3 radiance = light_triangle_radiance(scene, &light, b);
        origin = vec3_add(origin,
                          vec3_add_scaled(vec3_scale(VEC3_OF(light.edge1), b.x), VEC3_OF(light.edge2), b.y));
        const float solid_angle = f->casters ? photon_aim(casters, f->casters, origin, pick, aim, &direction)
                                             : photon_aimless(&light, axis, pick, aim, &direction);
        float cosine = vec3_dot(axis, direction);
        if (light.flags & MATERIAL_DOUBLE_SIDED) cosine = fabs(cosine);
        const float outside = copysign(32.0f * 0x1.0p-23f, vec3_dot(axis, direction));
        origin = vec3_add_scaled(origin, axis, outside * vec3_largest_abs(origin));
        if (cosine > 0.0f) s.power = vec3_scale(radiance, cosine * light.area * solid_angle / probability);
#if TRIAD_CLEARCOAT
        s.power = vec3_scale(s.power, coat_light(scene, &light, b, direction));
#endif
        s.ray.skip_instance = 0u; /* emissive geometry is flattened */
        s.ray.skip_primitive = light.primitive;
    }
#endif
#if TRIAD_PUNCTUAL_LIGHTS
    if (light.type == LIGHT_POINT || light.type == LIGHT_SPOT) {
        const float solid_angle = f->casters ? photon_aim(casters, f->casters, origin, pick, aim, &direction)
                                             : photon_aimless(&light, axis, pick, aim, &direction);
        s.power = vec3_scale(colour, solid_angle / probability);
        if (light.type == LIGHT_SPOT)
            s.power = vec3_scale(
                s.power,
                math_square(math_clamp(fma(vec3_dot(axis, direction), light.cone_scale, light.cone_offset),
                                       0.0f, 1.0f)));
        s.range = light.range;
    }
    if (light.type == LIGHT_DIRECTIONAL)
        s.power =
            vec3_scale(colour, photon_aim_from_afar(f, casters, direction, pick, aim, &origin) / probability);
#endif
#if TRIAD_ENVIRONMENT_MAP
    if (light.type == LIGHT_ENVIRONMENT) {
        const Environment e = scene->frame->environment;
        Vec2 uv;
        float pdf;
        direction = vec3_negate(environment_sample(scene, &e, u->set[0], &uv));
        const Vec3 radiance = environment_lookup(scene, &e, uv, &pdf);
        if (pdf > 0.0f)
            s.power = vec3_scale(radiance, photon_aim_from_afar(f, casters, direction, pick, aim, &origin) /
                                               (probability * pdf));
    }
#endif
    s.ray.origin[0] = origin.x, s.ray.origin[1] = origin.y, s.ray.origin[2] = origin.z;
    s.ray.direction[0] = direction.x, s.ray.direction[1] = direction.y, s.ray.direction[2] = direction.z;
    return s;
}

#endif
