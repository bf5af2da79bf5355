/* A surface's emission lies below its varnish (KHR_materials_clearcoat): what the varnish leaves of it. Paths
 * that hit the surface and those that sample it as a light ask the same function, so that they agree. */
#ifndef TRIAD_SHADING_COAT_EMISSION_H
#define TRIAD_SHADING_COAT_EMISSION_H

#include "shading/clearcoat.h"
#include "shading/vertex.h"

#if TRIAD_CLEARCOAT
/* Share that gets out towards wo: as of all that is below a varnish, 1 less its albedo. ng: the geometric
 * normal on wo's side; back: that is the inner side. Of s: coat, coat_roughness, coat_normal, material. */
TRIAD_FUNCTION float coat_emission(const Scene* scene, const Surface* s, Vec3 wo, Vec3 ng, int back) {
    if (!(s->coat > 0.0f) || (back && (scene->materials[s->material].flags & MATERIAL_SOLID))) return 1.0f;
    const Vec3 n = vertex_shading_normal(back ? vec3_negate(s->coat_normal) : s->coat_normal, ng, wo, 1.0f);
    float weight;
    return 1.0f -
           coat_albedo(scene->albedo, s->coat, s->coat_roughness, math_max(vec3_dot(n, wo), 0.0f), &weight);
}

#if TRIAD_TRIANGLE_LIGHTS
/* The same of a triangle light, at barycentric weights b of its corners 1 and 2. */
TRIAD_FUNCTION float coat_light(const Scene* scene, const Light* light, Vec2 b, Vec3 wo) {
    const Triangle t = scene->triangles[light->primitive];
    const Geometry g = scene->geometries[t.geometry];
    global const Material* m = scene->materials + g.material;
    if (m->extensions == TRIAD_NONE || !(scene->extensions[m->extensions].clearcoat.factor > 0.0f))
        return 1.0f;
    const Vec3 n = VEC3_OF(light->axis);
    Surface s;
    Vec4 colour;
    s.material = g.material;
    s.geometric_normal = n;
    surface_attributes(scene, &g, &t, b.x, b.y, &s.uv0, &s.uv1, &colour);
    /* emissive geometry is flattened: instance 0 */
    surface_coat(scene, m, &g, &t, b.x, b.y, 0u, surface_smooth_normal(scene, &g, &t, b.x, b.y, 0u, n), &s);
    const int back = vec3_dot(n, wo) < 0.0f;
    return coat_emission(scene, &s, wo, back ? vec3_negate(n) : n, back);
}
#endif
#endif

#endif
