#pragma once
/// Turns hits into shading points.

#include "render/ray_offset.h"
#include "render_cpu/kernel.h"
#include "render_cpu/kernel/instances.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/round_points.h"
#include "render_cpu/kernel/single_lane.h"
#include "render_cpu/kernel/texture.h"

#include <nusselt/estimate/line_light.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The BRDF of each lane.
struct SurfaceBrdf {
    Lambert<Real> lambert; ///< also the diffuse component of Phong surfaces
    Frostbite<Real> frostbite;
    Phong<Real> phong; ///< the lobe, black for other surfaces
    LaneMask is_frostbite, is_phong;

    Vector eval(const Vector& wi) const noexcept {
        Vector value = lambert.eval(wi);
        if (any(is_phong)) value = value + phong.eval(wi);
        if (any(is_frostbite)) value = select(is_frostbite, frostbite.eval(wi), value);
        return value;
    }

    BrdfComponents<Real> eval_components(const Vector& wi) const noexcept {
        BrdfComponents<Real> value = lambert.eval_components(wi);
        if (any(is_phong)) value.specular = phong.eval(wi);
        if (!any(is_frostbite)) return value;
        const BrdfComponents<Real> of_frostbite = frostbite.eval_components(wi);
        return {select(is_frostbite, of_frostbite.diffuse, value.diffuse),
                select(is_frostbite, of_frostbite.specular, value.specular)};
    }
};

/// Shading points. Lanes that are not valid may hold any numbers, NaN included, and must be masked.
struct Surface {
    LaneMask valid;
    Vector position;         ///< world space [m]
    Vector geometric_normal; ///< unit, on the side of the eye
    Frame<Real> frame;       ///< shading_frame() of the shading normal, on the side of the eye as well
    Real offset;   ///< how far along the geometric normal shadow rays start [m], see render/ray_offset.h
    Indices light; ///< number of the light with this surface in the scene, -1 for none
    GlossySurface<Real, SurfaceBrdf> glossy;
};

/// Smallest cosine between the shading normal and the direction to the eye. Normals of a mesh that face away from the
/// eye are bent towards it.
inline constexpr float kSmallestEyeCosine = 1e-3f;

/// Interpolates vertex attributes over triangles.
struct Interpolation {
    Indices vertex[3];
    Real u, v;
    LaneMask active;
    /// Round lights, where u and v are the texture coordinates, and edges the derivatives by them.
    LaneMask is_round;

    Vector vectors(const scene::Float3* attribute) const noexcept {
        const float* rows = &attribute->x;
        const Vector a = gather_vector(rows, 3, 0, vertex[0], active);
        const Vector b = gather_vector(rows, 3, 0, vertex[1], active);
        const Vector c = gather_vector(rows, 3, 0, vertex[2], active);
        return a + u * (b - a) + v * (c - a);
    }

    /// A texture coordinate.
    Real uv(const scene::Float2* uvs, int index) const noexcept {
        const float* rows = &uvs->x;
        const Real a = gather_column(rows, 2, index, vertex[0], active);
        const Real b = gather_column(rows, 2, index, vertex[1], active);
        const Real c = gather_column(rows, 2, index, vertex[2], active);
        return select(is_round, index == 0 ? u : v, a + u * (b - a) + v * (c - a));
    }

    /// Differences of a texture coordinate between the second and the third vertex and the first.
    Vec2<Real> uv_differences(const scene::Float2* uvs, int index) const noexcept {
        const float* rows = &uvs->x;
        const Real a = gather_column(rows, 2, index, vertex[0], active);
        const auto to = [&](int corner) {
            const Real difference = gather_column(rows, 2, index, vertex[corner], active) - a;
            return select(is_round, Real(corner == index + 1 ? 1.0f : 0.0f), difference);
        };
        return {to(1), to(2)};
    }
};

inline Interpolation make_interpolation(const render_cpu::KernelScene& scene,
                                        const visibility::HitPacket<kLanes>& hits, LaneMask active,
                                        LaneMask is_round) noexcept {
    Interpolation result;
    for (int i = 0; i < kLanes; ++i) {
        const std::int32_t triangle = hits.triangle[i] < 0 ? 0 : hits.triangle[i];
        for (int k = 0; k < 3; ++k)
            result.vertex[k].lane[i] = static_cast<std::int32_t>(scene.triangles[triangle].vertex[k]);
    }
    result.u = Real::load(hits.u);
    result.v = Real::load(hits.v);
    result.active = active;
    result.is_round = is_round;
    return result;
}

/// The normal of the mesh in world space. It has unit length, or is zero for meshes without normals.
inline Vector interpolated_normal(const render_cpu::KernelScene& scene, const Interpolation& interpolation,
                                  const InstanceLanes& instances) noexcept {
    Vector n = interpolation.vectors(scene.normals);
    if (any(instances.mask)) n = WorldFromObject(scene, instances).normal(n);
    return normalize(n);
}

/// The kinds of textures in all lanes, as bits of TextureKind.
inline std::uint32_t texture_kinds(const render_cpu::KernelScene& scene, const Indices& material) noexcept {
    std::uint32_t kinds = 0;
    for (int i = 0; i < kLanes; ++i) kinds |= scene.material_texture_kinds[material.lane[i]];
    return kinds;
}

/// Directions along a surface, in world space.
struct Tangents {
    Vector u, v;
    Real volume; ///< normal . u x v
};

/// The derivatives of the position with respect to the texture coordinates, times the determinant.
/// \param du,dv differences of the texture coordinates along the edges
inline Tangents position_derivatives(const Vec2<Real>& du, const Vec2<Real>& dv, const Vector& e1,
                                     const Vector& e2, const Vector& n) noexcept {
    return {dv.y * e1 - dv.x * e2, du.x * e2 - du.y * e1, dot(n, cross(e1, e2))};
}

/// The tangents that pbrt v3 uses instead on meshes with normals, unlike on spheres and disks. They are orthonormal in
/// object space, and both are reversed.
/// \param metric the derivatives, which the other lanes keep
inline Tangents bump_tangents(const render_cpu::KernelScene& scene, const Interpolation& interpolation,
                              const InstanceLanes& instances, const Indices& material, const Vec2<Real>& du,
                              const Vec2<Real>& dv, const Vector& n, const Tangents& metric) noexcept {
    constexpr int kStride = sizeof(render_cpu::MaterialTextures) / sizeof(float);
    const float* flags = &scene.material_textures->is_bump_in_uv;
    const LaneMask active = interpolation.active;
    const auto is_in_uv = gather_column(flags, kStride, 0, material, active) > Real(0.5f);
    if (!any(is_in_uv & active)) return metric;
    const Vector normal = normalize(interpolation.vectors(scene.normals));
    const float* positions = &scene.positions->x;
    const Vector v0 = gather_vector(positions, 3, 0, interpolation.vertex[0], active);
    const Vector e1 = gather_vector(positions, 3, 0, interpolation.vertex[1], active) - v0;
    const Vector e2 = gather_vector(positions, 3, 0, interpolation.vertex[2], active) - v0;
    const Real determinant = du.x * dv.y - dv.x * du.y;
    const Vector along_u = copysign(Real(1), determinant) * position_derivatives(du, dv, e1, e2, normal).u;
    Vector v = normalize(cross(along_u, normal));
    Vector u = cross(v, normal);
    if (any(instances.mask)) {
        const WorldFromObject transform(scene, instances);
        u = transform.vector(u);
        v = transform.vector(v);
    }
    const auto is_changed = is_in_uv & !interpolation.is_round & (dot(normal, normal) > Real(0.5f));
    return {select(is_changed, u, metric.u), select(is_changed, v, metric.v),
            select(is_changed, dot(n, cross(u, v)), metric.volume)};
}

/// A normal perturbed by the normal map or the bump map of each lane; docs/materials.md has the formulas.
/// \param n     unit, on the front side
/// \param e1,e2 edges of the triangle from its first vertex, in the world; for round lights, the derivatives of the
///              position by the texture coordinates
inline Vector perturbed_normal(const render_cpu::KernelScene& scene, const Interpolation& interpolation,
                               const InstanceLanes& instances, const Indices& material, const Vec2<Real>& uv,
                               const Vector& e1, const Vector& e2, const Vector& n) noexcept {
    using render_cpu::MaterialTextures;
    const LaneMask active = interpolation.active;
    const Vec2<Real> du = interpolation.uv_differences(scene.uvs, 0);
    const Vec2<Real> dv = interpolation.uv_differences(scene.uvs, 1);
    const Real determinant = du.x * dv.y - dv.x * du.y;
    const Tangents metric = position_derivatives(du, dv, e1, e2, n);
    // Without texture coordinates, the determinant is 0. NaN fails the second comparison.
    const auto if_usable = [&](const Vector& perturbed) {
        const auto usable = (determinant != Real(0)) & (dot(perturbed, perturbed) > Real(0.5f));
        return select(usable, perturbed, n);
    };

    const TextureLanes bump = texture_lanes(scene, material, &MaterialTextures::bump, uv, active);
    constexpr int kStride = sizeof(MaterialTextures) / sizeof(float);
    const float* heights = &scene.material_textures->bump_height;
    const Tangents along = bump_tangents(scene, interpolation, instances, material, du, dv, n, metric);
    const Real height = gather_column(heights, kStride, 0, material, active) / along.volume;
    const auto bumped = [&](const render_cpu::TextureView& texture, const Vec2<Real>& at, LaneMask mask) {
        const Vec2<Real> derivatives = height_derivatives(texture, at, mask);
        const Vector gradient = (bump.scale.x * derivatives.x) * cross(along.v, n) +
                                (bump.scale.y * derivatives.y) * cross(n, along.u);
        return if_usable(normalize(n - height * gradient));
    };

    const TextureLanes map = texture_lanes(scene, material, &MaterialTextures::normal, uv, active);
    const Vector tangent = copysign(Real(1), determinant) * normalize(metric.u - dot(n, metric.u) * n);
    const Vector bitangent = cross(n, tangent);
    const auto mapped = [&](const render_cpu::TextureView& texture, const Vec2<Real>& at, LaneMask mask) {
        const Vector local = Real(2) * look_up_texture(texture, at, mask) - Vector{Real(1), Real(1), Real(1)};
        const Vector world = local.x * tangent + local.y * bitangent + local.z * n;
        return if_usable(copysign(Real(1), local.z) * normalize(world));
    };
    return look_up_textures(scene.textures, map, active,
                            look_up_textures(scene.textures, bump, active, n, bumped), mapped);
}

/// \param n  normal on either side
/// \param wo unit, world space
/// \returns the normal on the side of the eye, bent towards it where it faces away
inline Vector visible_normal(const Vector& n, const Vector& wo) noexcept {
    const Real missing = max(Real(kSmallestEyeCosine) - dot(n, wo), Real(0));
    return normalize(n + missing * wo);
}

/// The values of materials and textures for each lane.
struct MaterialLanes {
    Vector diffuse;
    Vector f0;
    Real roughness;
    Real exponent;
    LaneMask is_frostbite, is_phong;
};

inline MaterialLanes look_up_materials(const render_cpu::KernelScene& scene, const Indices& material,
                                       std::uint32_t kinds, const Vec2<Real>& uv, LaneMask active) noexcept {
    using render_cpu::MaterialTextures;
    constexpr int kStride = sizeof(render_cpu::MaterialRow) / sizeof(float);
    const float* rows = scene.materials->diffuse;
    const Real model = gather_column(rows, kStride, 8, material, active);
    const auto has_model = [&](scene::BrdfModel m) { return model == Real(static_cast<float>(m)); };
    MaterialLanes result{gather_vector(rows, kStride, 0, material, active),
                         gather_vector(rows, kStride, 3, material, active),
                         gather_column(rows, kStride, 6, material, active),
                         gather_column(rows, kStride, 7, material, active),
                         has_model(scene::BrdfModel::frostbite),
                         has_model(scene::BrdfModel::phong)};
    const auto times_texture = [&](scene::TextureUse MaterialTextures::*purpose, const Vector& factor) {
        const TextureLanes lanes = texture_lanes(scene, material, purpose, uv, active);
        // Factors above 1 are useful for dark images, but reflectances must not exceed 1.
        const auto product = [&](const render_cpu::TextureView& texture, const Vec2<Real>& at,
                                 LaneMask mask) {
            return min(factor * look_up_texture(texture, at, mask), Vector{Real(1), Real(1), Real(1)});
        };
        return look_up_textures(scene.textures, lanes, active, factor, product);
    };
    if ((kinds & render_cpu::kDiffuseTexture) != 0)
        result.diffuse = times_texture(&MaterialTextures::diffuse, result.diffuse);
    if ((kinds & render_cpu::kF0Texture) != 0) result.f0 = times_texture(&MaterialTextures::f0, result.f0);
    if ((kinds & render_cpu::kRoughnessTexture) != 0) {
        const Real& grey = result.roughness;
        result.roughness = times_texture(&MaterialTextures::roughness, {grey, grey, grey}).x;
    }
    return result;
}

inline LtcTableView view_of(const render_cpu::LtcTableRecord& table) noexcept {
    return {table.entries, table.roughnesses, table.inclinations, table.f0s};
}

/// The fit of the specular component of each lane, with an albedo of 0 where there is none or the job uses no fits.
inline SpecularFit<Real> fit_lobes(const render_cpu::KernelScene& scene, const MaterialLanes& material,
                                   const Real& cos_o) noexcept {
    const LtcCoefficients<Real> cosine{Real(1), Real(0), Real(1), Real(0), Real(1), Real(0)};
    SpecularFit<Real> fit{Ltc<Real>(cosine), {Real(0), Real(0), Real(0)}};
    if (scene.frostbite_lobes.entries != nullptr && any(material.is_frostbite))
        fit =
            select_lanes(material.is_frostbite,
                         fit_of(view_of(scene.frostbite_lobes), material.roughness, cos_o, material.f0), fit);
    if (scene.phong_lobes.entries != nullptr && any(material.is_phong))
        fit = select_lanes(material.is_phong,
                           phong_fit_of(view_of(scene.phong_lobes), material.exponent, cos_o, material.f0),
                           fit);
    return fit;
}

/// \param wo in shading space
inline GlossySurface<Real, SurfaceBrdf>
make_glossy(const render_cpu::KernelScene& scene, const MaterialLanes& material, const Vector& wo) noexcept {
    const Vector zero{Real(0), Real(0), Real(0)};
    const SurfaceBrdf brdf{{material.diffuse},
                           Frostbite<Real>(wo, material.diffuse, material.f0, material.roughness),
                           Phong<Real>(wo, select(material.is_phong, material.f0, zero), material.exponent),
                           material.is_frostbite,
                           material.is_phong};
    const SpecularFit<Real> fit = fit_lobes(scene, material, wo.z);
    const bool estimates_albedo = scene.frostbite_lobes.entries != nullptr && any(material.is_frostbite);
    return {wo,
            select(material.is_phong, phong_alpha(material.exponent), ggx_alpha(material.roughness)),
            brdf,
            fit.lobe,
            estimates_albedo
                ? select(material.is_frostbite, brdf.frostbite.diffuse_albedo(), material.diffuse)
                : material.diffuse,
            fit.albedo};
}

/// Makes the shading points for the active lanes that hit a surface.
/// \param wo unit direction to the eye, world space
inline Surface make_surface(const render_cpu::KernelScene& scene, const visibility::HitPacket<kLanes>& hits,
                            LaneMask active, const Vector& wo) noexcept {
    const RoundPoints round = round_points(scene, hits);
    const Interpolation interpolation = make_interpolation(scene, hits, active, round.mask);
    const float* positions = &scene.positions->x;
    const Vector v0 = gather_vector(positions, 3, 0, interpolation.vertex[0], active);
    Vector e1 = gather_vector(positions, 3, 0, interpolation.vertex[1], active) - v0;
    Vector e2 = gather_vector(positions, 3, 0, interpolation.vertex[2], active) - v0;
    Vector position = v0 + (interpolation.u * e1 + interpolation.v * e2);
    Real coordinate = max(max(abs(position.x), abs(position.y)), abs(position.z));
    const InstanceLanes instances = instance_lanes(scene, hits);
    if (any(instances.mask)) {
        const WorldFromObject transform(scene, instances);
        coordinate = transform.largest_coordinate(position, coordinate);
        position = transform.point(position);
        e1 = transform.vector(e1);
        e2 = transform.vector(e2);
    }

    Vector normal = normalize(cross(e1, e2));
    if (any(instances.mask)) normal = WorldFromObject(scene, instances).front(normal);
    if (any(round.mask)) {
        position = select(round.mask, round.position, position);
        coordinate = select(round.mask, round.coordinate, coordinate);
        e1 = select(round.mask, round.along_u, e1);
        e2 = select(round.mask, round.along_v, e2);
        normal = select(round.mask, normalize(round.normal), normal);
    }
    const Vector geometric_normal = copysign(Real(1), dot(normal, wo)) * normal;

    Indices material;
    Indices light;
    for (int i = 0; i < kLanes; ++i) {
        const std::int32_t triangle = hits.triangle[i] < 0 ? 0 : hits.triangle[i];
        material.lane[i] = static_cast<std::int32_t>(scene.triangle_material[triangle]);
        light.lane[i] = scene.triangle_light[triangle];
    }
    const std::uint32_t kinds = texture_kinds(scene, material);
    Vec2<Real> uv{Real(0), Real(0)};
    if (kinds != 0) uv = {interpolation.uv(scene.uvs, 0), interpolation.uv(scene.uvs, 1)};

    const Vector interpolated = interpolated_normal(scene, interpolation, instances);
    const auto is_smooth = (dot(interpolated, interpolated) > Real(0.5f)) & !round.mask;
    Vector n = select(is_smooth, interpolated, normal);
    const Real eye_side = copysign(Real(1), dot(n, geometric_normal));
    if ((kinds & (render_cpu::kNormalTexture | render_cpu::kBumpTexture)) != 0)
        n = perturbed_normal(scene, interpolation, instances, material, uv, e1, e2, n);
    const auto frame = shading_frame(visible_normal(eye_side * n, wo), wo);
    const MaterialLanes lanes = look_up_materials(scene, material, kinds, uv, active);

    const auto has_normal = dot(normal, normal) > Real(0.5f);
    return {active & has_normal & is_finite(coordinate),
            position,
            geometric_normal,
            frame,
            Real(render::kOffsetPerRadius) * Real(scene.radius) +
                Real(render::kOffsetPerCoordinate) * coordinate,
            light,
            make_glossy(scene, lanes, frame.to_local(wo))};
}

} // namespace kernel

/// Phong lobes by phong_part(), others by the fit.
template <>
struct SpecularAlongLines<kernel::Real, kernel::SurfaceBrdf> {
    using Real = kernel::Real;
    using Surface = GlossySurface<Real, kernel::SurfaceBrdf>;

    static constexpr bool kIsExact = false;

    static Vec3<Real> albedo(const Surface& surface) noexcept {
        return select(surface.brdf.is_phong, surface.brdf.phong.albedo(), surface.specular_albedo);
    }
    static Real integral(const Surface& surface, const LobeLine<Real>& cosine, const LobeLine<Real>& lobe,
                         const Interval<Real>& part) noexcept {
        const kernel::SurfaceBrdf& brdf = surface.brdf;
        if (!any(brdf.is_phong)) return lobe.integral(lobe.clipped(part));
        const Real of_phong = phong_part(cosine, part, brdf.phong.mirror(), brdf.phong.exponent());
        if (all(brdf.is_phong)) return of_phong;
        return select(brdf.is_phong, of_phong, lobe.integral(lobe.clipped(part)));
    }
};

NUSSELT_NAMESPACE_END
