#ifndef NUSSELT_PASSES_SURFACE_GLSL
#define NUSSELT_PASSES_SURFACE_GLSL
/// Turns drawn triangles into shading points, as src/render_cpu/kernel/surface.h does.

#include "nusselt/ltc/ltc.glsl"
#include "passes/texture.glsl"
#if ROUND_LIGHTS
#include "passes/rounds/round_surface.glsl"
#endif

/// The smallest cosine between the shading normal and the direction to the eye: normals of a mesh that face away from the
/// eye are bent back to it.
const float kSmallestEyeCosine = 1e-3;

/// Shadow rays start off the surface by this share of the scene's radius ...
const float kOffsetPerRadius = 1e-5;
/// ... plus this share of the largest coordinate, which bounds rounding errors of positions.
const float kOffsetPerCoordinate = 1e-6;

/// A shading point.
struct Surface {
    bool valid;
    vec3 position;         ///< world space [m]
    vec3 geometric_normal; ///< unit, on the side of the eye
    Frame shading;         ///< shading_frame() of the shading normal, on the side of the eye as well
    vec3 wo;               ///< unit direction to the eye, in shading space
    float offset;          ///< how far along the geometric normal shadow rays start [m]
    int light;             ///< number of the light that the surface belongs to, -1 for none
    // From the material and its textures.
    uint model;
    vec3 diffuse;
    vec3 f0;
    float roughness;
    float exponent;
};

vec3 vertex_normal(uint vertex) { return to_vec(vertices[vertex].normal); }

/// The normal of the mesh in object space, of any length; zero where it has none.
vec3 mesh_normal(uint triangle, vec2 at) {
    vec3 a = vertex_normal(triangles[triangle].vertex[0]);
    vec3 b = vertex_normal(triangles[triangle].vertex[1]);
    vec3 c = vertex_normal(triangles[triangle].vertex[2]);
    return a + at.x * (b - a) + at.y * (c - a);
}

vec3 world_normal(int instance, vec3 n) {
    if (instance < 0) return n;
    float m[9] = instances[instance].normal_from_object;
    return vec3(m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.x + m[4] * n.y + m[5] * n.z,
                m[6] * n.x + m[7] * n.y + m[8] * n.z);
}

/// A coordinate whose rounding errors are larger than those of the point in the world.
/// \param p in object space
float largest_coordinate(int instance, vec3 p) {
    if (instance < 0) return largest_component(p);
    float m[12] = instances[instance].world_from_object;
    vec3 x = vec3(abs(m[0]) * abs(p.x) + abs(m[1]) * abs(p.y) + abs(m[2]) * abs(p.z) + abs(m[3]),
                  abs(m[4]) * abs(p.x) + abs(m[5]) * abs(p.y) + abs(m[6]) * abs(p.z) + abs(m[7]),
                  abs(m[8]) * abs(p.x) + abs(m[9]) * abs(p.y) + abs(m[10]) * abs(p.z) + abs(m[11]));
    return instances[instance].rounding * largest_component(x);
}

/// Where a camera ray meets a surface.
struct SurfacePoint {
    vec3 position;   ///< world space [m]
    vec3 normal;     ///< unit, to the front; zero where there is none
    vec3 smooth_normal; ///< the same, interpolated over meshes
    float coordinate; ///< whose rounding errors are larger than those of the position [m]
    vec2 at;         ///< barycentric coordinates
    vec2 uv;         ///< only for materials with textures
    vec3 e1, e2;     ///< edges of the triangle from its first vertex, in the world; of round lights, the derivatives by uv
};

/// Two tangents of a surface, in the world.
struct Tangents {
    vec3 u, v;
    float volume; ///< normal . u x v
};

/// The derivatives of the position by the texture coordinates, times the determinant.
/// \param du,dv differences of the texture coordinates along the edges
Tangents position_derivatives(vec2 du, vec2 dv, vec3 e1, vec3 e2, vec3 n) {
    return Tangents(dv.y * e1 - dv.x * e2, du.x * e2 - du.y * e1, dot(n, cross(e1, e2)));
}

/// The tangents that pbrt v3 uses instead on meshes with normals: orthonormal in the object, and both reversed.
/// \param metric the tangents of other meshes
Tangents tangents_in_uv(const DrawnTriangle drawn, vec2 at, vec2 du, vec2 dv, vec3 n, const Tangents metric) {
    TriangleEdges edges = triangle_edges(drawn.triangle);
    vec3 normal = nusselt_normalize(mesh_normal(drawn.triangle, at));
    if (!(dot(normal, normal) > 0.5)) return metric;
    float determinant = du.x * dv.y - dv.x * du.y;
    vec3 along_u = copysign(1.0, determinant) * position_derivatives(du, dv, edges.e1, edges.e2, normal).u;
    vec3 v = nusselt_normalize(cross(along_u, normal));
    vec3 u = world_vector(drawn.instance, cross(v, normal));
    v = world_vector(drawn.instance, v);
    return Tangents(u, v, dot(n, cross(u, v)));
}

/// A normal perturbed by the normal map or the bump map; docs/materials.md has the formulas.
vec3 perturbed_normal(const DrawnTriangle drawn, const SurfacePoint point, const MaterialRecord material) {
    vec2 du = vec2(1.0, 0.0);
    vec2 dv = vec2(0.0, 1.0);
    if (drawn.round < 0) {
        VertexRecord a = vertices[triangles[drawn.triangle].vertex[0]];
        VertexRecord b = vertices[triangles[drawn.triangle].vertex[1]];
        VertexRecord c = vertices[triangles[drawn.triangle].vertex[2]];
        du = vec2(b.uv[0] - a.uv[0], c.uv[0] - a.uv[0]);
        dv = vec2(b.uv[1] - a.uv[1], c.uv[1] - a.uv[1]);
    }
    float determinant = du.x * dv.y - dv.x * du.y;
    vec3 n = point.smooth_normal;
    Tangents metric = position_derivatives(du, dv, point.e1, point.e2, n);
    vec3 perturbed;
    if ((kTextureKinds & material.texture_kinds & kNormalTexture) != 0u) {
        vec3 tangent = copysign(1.0, determinant) * nusselt_normalize(metric.u - dot(n, metric.u) * n);
        vec3 bitangent = cross(n, tangent);
        vec3 local =
            2.0 * look_up_texture(material.normal_texture.texture, lookup_place(material.normal_texture, point.uv)) -
            vec3(1.0);
        perturbed =
            copysign(1.0, local.z) * nusselt_normalize(local.x * tangent + local.y * bitangent + local.z * n);
    } else {
        Tangents along = metric;
        if (material.is_bump_in_uv != 0u && drawn.round < 0)
            along = tangents_in_uv(drawn, point.at, du, dv, n, metric);
        vec2 derivatives =
            height_derivatives(material.bump_texture.texture, lookup_place(material.bump_texture, point.uv));
        vec3 gradient = (material.bump_texture.scale[0] * derivatives.x) * cross(along.v, n) +
                        (material.bump_texture.scale[1] * derivatives.y) * cross(n, along.u);
        perturbed = nusselt_normalize(n - (material.bump_height / along.volume) * gradient);
    }
    // Without texture coordinates the tangents are undefined. NaN fails the second comparison.
    return determinant != 0.0 && dot(perturbed, perturbed) > 0.5 ? perturbed : n;
}

/// \param n  on either side
/// \param wo unit, world space
/// \returns the normal on the side of the eye, bent to it where it faces away
vec3 visible_normal(vec3 n, vec3 wo) { return nusselt_normalize(n + nusselt_max(kSmallestEyeCosine - dot(n, wo), 0.0) * wo); }

/// Factors above 1 brighten dark images, but reflectances must not exceed 1.
vec3 times_texture(vec3 factor, const TextureLookup lookup, vec2 uv) {
    return nusselt_min(factor * look_up_texture(lookup.texture, lookup_place(lookup, uv)), vec3(1.0));
}

void look_up_material(inout Surface surface, const MaterialRecord material, vec2 uv) {
    surface.model = material.model;
    surface.diffuse = to_vec(material.diffuse);
    surface.f0 = to_vec(material.f0);
    surface.roughness = material.roughness;
    surface.exponent = material.exponent;
    uint kinds = kTextureKinds & material.texture_kinds;
    if ((kinds & kDiffuseTexture) != 0u)
        surface.diffuse = times_texture(surface.diffuse, material.diffuse_texture, uv);
    if ((kinds & kF0Texture) != 0u) surface.f0 = times_texture(surface.f0, material.f0_texture, uv);
    if ((kinds & kRoughnessTexture) != 0u)
        surface.roughness = times_texture(vec3(surface.roughness), material.roughness_texture, uv).x;
}

/// \param drawn a triangle of a surface
/// \param has_textures whether texture coordinates matter
SurfacePoint triangle_point(const DrawnTriangle drawn, const Ray ray, bool has_textures) {
    SurfacePoint point;
    TriangleEdges edges = triangle_edges(drawn.triangle);
    point.at = barycentrics(drawn, edges, ray);
    point.e1 = world_vector(drawn.instance, edges.e1);
    point.e2 = world_vector(drawn.instance, edges.e2);
    point.normal = nusselt_normalize(cross(point.e1, point.e2));
    if (drawn.instance >= 0) point.normal = instances[drawn.instance].handedness * point.normal;
    vec3 p = edges.v0 + (point.at.x * edges.e1 + point.at.y * edges.e2);
    point.position = world_point(drawn.instance, p);
    point.coordinate = largest_coordinate(drawn.instance, p);
    vec3 interpolated = nusselt_normalize(world_normal(drawn.instance, mesh_normal(drawn.triangle, point.at)));
    point.smooth_normal = dot(interpolated, interpolated) > 0.5 ? interpolated : point.normal;
    point.uv = vec2(0.0);
    if (has_textures) point.uv = interpolated_uv(drawn.triangle, point.at);
    return point;
}

#if ROUND_LIGHTS
/// The same for a round light.
SurfacePoint round_point(const DrawnTriangle drawn, const Ray ray, bool has_textures) {
    uint light = uint(drawn.round);
    UnitRay unit = unit_ray(light, ray.origin, ray.direction);
    vec3 p = crossing_point(light, unit, round_crossings(light, unit, 1.0), drawn.crossing);
    vec3 offset = from_unit_sphere(light, p);
    vec3 center = to_vec(round_lights[light].center);
    bool is_flat_light = is_flat(light);
    SurfacePoint point;
    point.position = center + offset;
    float front = round_lights[light].emits_outwards != 0u ? 1.0 : -1.0;
    point.normal = is_flat_light ? to_vec(round_lights[light].normal)
                                 : nusselt_normalize(front * normal_of_unit_sphere(light, p));
    point.smooth_normal = point.normal;
    point.coordinate = largest_component(center) + largest_component(offset);
    point.at = vec2(0.0);
    point.uv = vec2(0.0);
    if (has_textures) point.uv = round_texture_coordinates(light, p);
    float radius = sqrt(dot(p.xy, p.xy));
    vec2 outwards = radius > 0.0 ? p.xy / radius : vec2(1.0, 0.0);
    point.e1 = from_unit_sphere(light, 2.0 * kNusseltPi * vec3(-p.y, p.x, 0.0));
    vec3 to_pole = is_flat_light ? vec3(-outwards, 0.0) : kNusseltPi * vec3(-p.z * outwards, radius);
    point.e2 = from_unit_sphere(light, to_pole);
    return point;
}
#endif

/// \param drawn a surface
/// \param ray   a camera ray that hits it
Surface make_surface(const DrawnTriangle drawn, const Ray ray) {
    vec3 wo = -nusselt_normalize(ray.direction);
    MaterialRecord material = materials[triangles[drawn.triangle].material];
    uint kinds = kTextureKinds & material.texture_kinds;
    SurfacePoint point;
#if ROUND_LIGHTS
    if (kHasRounds && drawn.round >= 0)
        point = round_point(drawn, ray, kinds != 0u);
    else
#endif
        point = triangle_point(drawn, ray, kinds != 0u);

    Surface surface;
    surface.position = point.position;
    surface.geometric_normal = copysign(1.0, dot(point.normal, wo)) * point.normal;
    surface.offset = kOffsetPerRadius * scene.radius + kOffsetPerCoordinate * point.coordinate;
    surface.valid = dot(point.normal, point.normal) > 0.5 && is_finite(point.coordinate);
    surface.light = triangles[drawn.triangle].light;

    vec3 n = point.smooth_normal;
    float eye_side = copysign(1.0, dot(n, surface.geometric_normal));
    if ((kinds & (kNormalTexture | kBumpTexture)) != 0u) n = perturbed_normal(drawn, point, material);
    surface.shading = shading_frame(visible_normal(eye_side * n, wo), wo);
    surface.wo = frame_to_local(surface.shading, wo);
    look_up_material(surface, material, point.uv);
    return surface;
}

#endif
