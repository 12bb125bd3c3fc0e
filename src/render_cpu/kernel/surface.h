#pragma once
/// From hits to shading points.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/instances.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/texture.h"

#include <nusselt/estimate/surface.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The BRDF of each lane.
struct SurfaceBrdf {
    Lambert<Real> lambert;
    Frostbite<Real> frostbite;
    LaneMask is_frostbite;

    Vector eval(const Vector& wi) const noexcept {
        if (!any(is_frostbite)) return lambert.eval(wi);
        return select(is_frostbite, frostbite.eval(wi), lambert.eval(wi));
    }

    BrdfComponents<Real> eval_components(const Vector& wi) const noexcept {
        const BrdfComponents<Real> of_lambert = lambert.eval_components(wi);
        if (!any(is_frostbite)) return of_lambert;
        const BrdfComponents<Real> of_frostbite = frostbite.eval_components(wi);
        return {select(is_frostbite, of_frostbite.diffuse, of_lambert.diffuse),
                select(is_frostbite, of_frostbite.specular, of_lambert.specular)};
    }
};

/// Shading points. Lanes that are not valid hold finite or infinite numbers or NaN and must be masked.
struct Surface {
    LaneMask valid;
    Vector position;         ///< world space [m]
    Vector geometric_normal; ///< unit, on the side of the eye
    Frame<Real> frame;       ///< shading_frame() of the shading normal, on the side of the eye as well
    Real offset;             ///< how far along the geometric normal shadow rays start [m]
    Indices light;           ///< polygonal light that the surface belongs to, -1 for none
    GlossySurface<Real, SurfaceBrdf> glossy;
};

/// Smallest cosine between shading normal and direction to the eye: normals of a mesh that face away from the
/// eye are bent back to it.
inline constexpr float kSmallestEyeCosine = 1e-3f;

/// Shadow rays start off the surface by this share of the scene's radius ...
inline constexpr float kOffsetPerRadius = 1e-5f;
/// ... plus this share of the largest coordinate, which bounds rounding errors of positions.
inline constexpr float kOffsetPerCoordinate = 1e-6f;

/// Interpolates vertex attributes over triangles.
struct Interpolation {
    Indices vertex[3];
    Real u, v;
    LaneMask active;

    Vector vectors(const scene::Float3* attribute) const noexcept {
        const float* rows = &attribute->x;
        const Vector a = gather_vector(rows, 3, 0, vertex[0], active);
        const Vector b = gather_vector(rows, 3, 0, vertex[1], active);
        const Vector c = gather_vector(rows, 3, 0, vertex[2], active);
        return a + u * (b - a) + v * (c - a);
    }

    Real column(const scene::Float2* attribute, int index) const noexcept {
        const float* rows = &attribute->x;
        const Real a = gather_column(rows, 2, index, vertex[0], active);
        const Real b = gather_column(rows, 2, index, vertex[1], active);
        const Real c = gather_column(rows, 2, index, vertex[2], active);
        return a + u * (b - a) + v * (c - a);
    }
};

inline Interpolation make_interpolation(const render_cpu::KernelScene& scene,
                                        const visibility::HitPacket<kLanes>& hits, LaneMask active) noexcept {
    Interpolation result;
    for (int i = 0; i < kLanes; ++i) {
        const std::int32_t triangle = hits.triangle[i] < 0 ? 0 : hits.triangle[i];
        for (int k = 0; k < 3; ++k)
            result.vertex[k].lane[i] = static_cast<std::int32_t>(scene.triangles[triangle].vertex[k]);
    }
    result.u = Real::load(hits.u);
    result.v = Real::load(hits.v);
    result.active = active;
    return result;
}

/// The normal of the mesh in world space: unit length, or zero where it has none.
inline Vector interpolated_normal(const render_cpu::KernelScene& scene, const Interpolation& interpolation,
                                  const InstanceLanes& instances) noexcept {
    Vector n = interpolation.vectors(scene.normals);
    if (any(instances.mask)) n = WorldFromObject(scene, instances).normal(n);
    return normalize(n);
}

/// \param interpolated see interpolated_normal()
/// \param wo           unit, world space
inline Vector shading_normal(const Vector& interpolated, const Vector& geometric_normal,
                             const Vector& wo) noexcept {
    const auto usable = dot(interpolated, interpolated) > Real(0.5f);
    Vector n = select(usable, interpolated, geometric_normal);
    n = copysign(Real(1), dot(n, geometric_normal)) * n;
    const Real missing = max(Real(kSmallestEyeCosine) - dot(n, wo), Real(0));
    return normalize(n + missing * wo);
}

/// What materials and textures say about each lane.
struct MaterialLanes {
    Vector diffuse;
    Vector f0;
    Real roughness;
    LaneMask is_frostbite;
};

inline MaterialLanes look_up_materials(const render_cpu::KernelScene& scene,
                                       const Interpolation& interpolation, const Indices& material) noexcept {
    const LaneMask active = interpolation.active;
    Indices texture;
    bool any_texture = false;
    for (int i = 0; i < kLanes; ++i) {
        texture.lane[i] = scene.material_texture[material.lane[i]];
        any_texture |= texture.lane[i] >= 0;
    }
    constexpr int kStride = sizeof(render_cpu::MaterialRow) / sizeof(float);
    const float* rows = scene.materials->diffuse;
    Vector albedo = gather_vector(rows, kStride, 0, material, active);
    if (any_texture) {
        const Vec2<Real> uv{interpolation.column(scene.uvs, 0), interpolation.column(scene.uvs, 1)};
        albedo = albedo * look_up_textures(scene.textures, texture, uv, active);
    }
    const Real is_frostbite = gather_column(rows, kStride, 7, material, active);
    return {albedo, gather_vector(rows, kStride, 3, material, active),
            gather_column(rows, kStride, 6, material, active), is_frostbite > Real(0.5f)};
}

/// \param wo in shading space
inline GlossySurface<Real, SurfaceBrdf> make_glossy(const render_cpu::LtcTableRecord& table,
                                                    const MaterialLanes& material,
                                                    const Vector& wo) noexcept {
    const SurfaceBrdf brdf{{material.diffuse},
                           Frostbite<Real>(wo, material.diffuse, material.f0, material.roughness),
                           material.is_frostbite};
    const Vector zero{Real(0), Real(0), Real(0)};
    if (table.entries == nullptr || !any(material.is_frostbite)) {
        const LtcCoefficients<Real> cosine{Real(1), Real(0), Real(1), Real(0), Real(1), Real(0)};
        return {wo, ggx_alpha(material.roughness), brdf, Ltc<Real>(cosine), material.diffuse, zero};
    }
    const LtcTableView view{table.entries, table.roughnesses, table.inclinations, table.f0s};
    const SpecularFit<Real> fit = fit_of(view, material.roughness, wo.z, material.f0);
    return {wo,
            ggx_alpha(material.roughness),
            brdf,
            fit.lobe,
            select(material.is_frostbite, brdf.frostbite.diffuse_albedo(), material.diffuse),
            select(material.is_frostbite, fit.albedo, zero)};
}

/// The shading points of those active lanes that hit a triangle.
/// \param wo unit direction to the eye, world space
inline Surface make_surface(const render_cpu::KernelScene& scene, const visibility::HitPacket<kLanes>& hits,
                            LaneMask active, const Vector& wo) noexcept {
    const Interpolation interpolation = make_interpolation(scene, hits, active);
    const float* positions = &scene.positions->x;
    const Vector v0 = gather_vector(positions, 3, 0, interpolation.vertex[0], active);
    Vector e1 = gather_vector(positions, 3, 0, interpolation.vertex[1], active) - v0;
    Vector e2 = gather_vector(positions, 3, 0, interpolation.vertex[2], active) - v0;
    Vector position = v0 + (interpolation.u * e1 + interpolation.v * e2);
    Real coordinate = max(max(abs(position.x), abs(position.y)), abs(position.z));
    const InstanceLanes instances = instance_lanes(hits);
    if (any(instances.mask)) {
        const WorldFromObject transform(scene, instances);
        coordinate = transform.largest_coordinate(position, coordinate);
        position = transform.point(position);
        e1 = transform.vector(e1);
        e2 = transform.vector(e2);
    }

    const Vector normal = normalize(cross(e1, e2));
    const Vector geometric_normal = copysign(Real(1), dot(normal, wo)) * normal;
    const Vector n =
        shading_normal(interpolated_normal(scene, interpolation, instances), geometric_normal, wo);
    const auto frame = shading_frame(n, wo);

    Indices material;
    Indices light;
    for (int i = 0; i < kLanes; ++i) {
        const std::int32_t triangle = hits.triangle[i] < 0 ? 0 : hits.triangle[i];
        material.lane[i] = static_cast<std::int32_t>(scene.triangle_material[triangle]);
        light.lane[i] = scene.triangle_light[triangle];
    }
    const auto has_normal = dot(normal, normal) > Real(0.5f);
    return {active & has_normal & is_finite(coordinate),
            position,
            geometric_normal,
            frame,
            Real(kOffsetPerRadius) * Real(scene.radius) + Real(kOffsetPerCoordinate) * coordinate,
            light,
            make_glossy(scene.ltc, look_up_materials(scene, interpolation, material), frame.to_local(wo))};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
