#pragma once
/// Polygonal lights with room for N vertices.

#include "render_cpu/kernel/lights/luminaire.h"
#include "render_cpu/kernel/lights/stored_polygon.h"
#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/single_lane.h"
#include "render_cpu/lights/polygon_records.h"

#include <nusselt/emission/texture.h>
#include <nusselt/emission/texture_plane.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

inline const render_cpu::PolygonRecord& polygon_record(const render_cpu::LightSet& lights,
                                                       std::int32_t index) noexcept {
    return static_cast<const render_cpu::PolygonRecords*>(lights.records)->lights[index];
}

/// The texture of a light, null for uniform radiance.
inline const render_cpu::PolygonTexture* texture_of(const render_cpu::LightSet& lights,
                                                    std::int32_t index) noexcept {
    const std::int32_t texture = polygon_record(lights, index).texture;
    return texture < 0 ? nullptr
                       : static_cast<const render_cpu::PolygonRecords*>(lights.records)->textures + texture;
}

/// The profile of a light, null for the same radiance in all directions.
inline const render_cpu::PolygonProfile* profile_of(const render_cpu::LightSet& lights,
                                                    std::int32_t index) noexcept {
    const std::int32_t profile = polygon_record(lights, index).profile;
    return profile < 0 ? nullptr
                       : static_cast<const render_cpu::PolygonRecords*>(lights.records)->profiles + profile;
}

/// The axes of a profile, the normal of its polygon, and the direction of its honeycomb, in any frame.
template <class R>
struct ProfileAxes {
    Vec3<R> x, y, z, normal, holes;
};

/// The axes in world space.
inline ProfileAxes<float> axes_of(const render_cpu::PolygonProfile& profile) noexcept {
    return {to_vec(profile.x_axis), to_vec(profile.y_axis), to_vec(profile.z_axis), to_vec(profile.normal),
            to_vec(profile.hole_axis)};
}

/// The axes in shading space.
inline ProfileAxes<Real> local_axes(const render_cpu::PolygonProfile& profile,
                                    const Surface& surface) noexcept {
    const ProfileAxes<float> world = axes_of(profile);
    const auto local = [&](const Vec3<float>& axis) { return surface.frame.to_local(broadcast<Real>(axis)); };
    return {local(world.x), local(world.y), local(world.z), local(world.normal), local(world.holes)};
}

/// The radiance in a direction over its mean. \param away unit, from the light, in the frame of the axes
inline float relative_radiance(const render_cpu::PolygonProfile& profile, const ProfileAxes<float>& axes,
                               const Vec3<float>& away) noexcept {
    float share = spread_share(profile, axes.normal, away);
    const scene::Float2& holes = profile.inverse_holes;
    if (holes.x > 0 || holes.y > 0) {
        const float along = dot(axes.normal, away);
        const Vec3<float> across = away - along * axes.normal;
        const float distance = max(abs(along), kTiny<float>);
        share *= max(1 - abs(dot(axes.holes, across)) / distance * holes.x, 0.0f) *
                 max(1 - abs(dot(cross(axes.normal, axes.holes), across)) / distance * holes.y, 0.0f);
    }
    if (!(share > 0)) return 0;
    return share * relative_luminance(profile, {dot(axes.x, away), dot(axes.y, away), dot(axes.z, away)});
}

inline TexturePlane<float> plane_of(const render_cpu::PolygonTexture& texture) noexcept {
    return {to_vec(texture.corner), to_vec(texture.side_x), to_vec(texture.side_y), to_vec(texture.normal)};
}

/// The plane of a texture in shading space.
inline TexturePlane<Real> local_plane(const render_cpu::PolygonTexture& texture,
                                      const Surface& surface) noexcept {
    const TexturePlane<float> plane = plane_of(texture);
    const TexturePlane<Real> world{broadcast<Real>(plane.corner), broadcast<Real>(plane.side_x),
                                   broadcast<Real>(plane.side_y), broadcast<Real>(plane.normal)};
    return to_shading_space(world, surface.position, surface.frame);
}

/// Radiance at texture coordinates [W/(sr m^2)].
inline Vec3<float> radiance_at(const render_cpu::PolygonTexture& texture, const Vec2<float>& at) noexcept {
    static_assert(sizeof(Vec3<float>) == sizeof(scene::Float3));
    const TextureView<float> view{reinterpret_cast<const Vec3<float>*>(texture.radiance), texture.width,
                                  texture.height};
    return BilinearFilter::lookup(view, at);
}

/// The same for each lane, where coordinates may be a little outside of [0, 1].
inline Vector radiance_at(const render_cpu::PolygonTexture& texture, const Vec2<Real>& at) noexcept {
    Lanes radiance;
    float x[kLanes];
    float y[kLanes];
    // Comparisons with NaN are false.
    select(at.x > Real(0), at.x, Real(0)).store(x);
    select(at.y > Real(0), at.y, Real(0)).store(y);
    for (int i = 0; i < kLanes; ++i) {
        const Vec3<float> value = radiance_at(texture, Vec2<float>{x[i], y[i]});
        radiance.x[i] = value.x;
        radiance.y[i] = value.y;
        radiance.z[i] = value.z;
    }
    return load(radiance);
}

/// A polygon in shading space.
template <int N>
struct LocalPolygon : ConvexPolygon<Real, N> {
    const render_cpu::PolygonTexture* texture; ///< null for uniform radiance
    const render_cpu::PolygonProfile* profile; ///< null for the same radiance in all directions

    /// Multiplies a sample by the radiance at its point and in its direction over the mean.
    void modulate(const Surface& surface, DirectLightSample<Real>& sample) const noexcept {
        if (profile != nullptr) modulate_by_profile(surface, sample);
        if (texture == nullptr) return;
        const Vec2<Real> at = TextureCoordinates<Real>(local_plane(*texture, surface))(sample.p);
        sample.shadowed =
            (broadcast<Real>(to_vec(texture->inverse_mean)) * radiance_at(*texture, at)) * sample.shadowed;
    }

private:
    void modulate_by_profile(const Surface& surface, DirectLightSample<Real>& sample) const noexcept {
        const ProfileAxes<Real> axes = local_axes(*profile, surface);
        const Vector away = -sample.wi;
        alignas(4 * kLanes) float factor[kLanes];
        for (int i = 0; i < kLanes; ++i)
            factor[i] = relative_radiance(*profile, single_lane<ProfileAxes<float>>(axes, i),
                                          single_lane<Vec3<float>>(away, i));
        sample.shadowed = Real::load(factor) * sample.shadowed;
    }
};

/// A kind of light as point_samples.h describes it.
template <int N>
struct PolygonLight : PolygonTechniques<N> {
    using Shape = LocalPolygon<N>;

    /// In world space.
    static ConvexPolygon<float, N> world(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
        const auto& records = *static_cast<const render_cpu::PolygonRecords*>(lights.records);
        const render_cpu::PolygonRecord& record = records.lights[index];
        return stored_polygon<N>(records.corners + record.first_corner, record.normal);
    }

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::PolygonRecord& record = polygon_record(lights, index);
        const Surface& surface = reflected.surface();
        const auto local = to_shading_space(world(lights, index), surface.position, surface.frame);

        const std::int32_t number = lights.first + index;
        // A planar light does not light itself, but rounding may put a point of it in front of its plane.
        LaneMask lit = reflected.lanes() & !reflected.on_light(number);
        // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
        if (record.two_sided == 0) lit &= !(dot(local.normal, local.vertex[0]) >= Real(0));
        lit &= !(highest_vertex(local) <= Real(0));
        return {{local, texture_of(lights, index), profile_of(lights, index)},
                lit,
                broadcast<Real>(to_vec(record.radiance)),
                static_cast<std::uint32_t>(number)};
    }
};

/// The function that takes points of polygons as a job demands.
template <int N>
render_cpu::AddLight polygon_points(const render_cpu::RenderJob& job) noexcept;
/// The function that takes lines in place of points.
template <int N>
render_cpu::AddLight polygon_lines() noexcept;
/// The function that takes points of polygons with a texture as a job demands.
template <int N>
render_cpu::AddLight textured_points(const render_cpu::RenderJob& job) noexcept;

/// The function that takes points of polygons with a profile as a job demands.
template <int N>
render_cpu::AddLight profiled_points(const render_cpu::RenderJob& job) noexcept;

template <>
render_cpu::AddLight polygon_points<4>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight polygon_points<8>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight textured_points<4>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight textured_points<8>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight profiled_points<4>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight profiled_points<8>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight polygon_lines<4>() noexcept;
template <>
render_cpu::AddLight polygon_lines<8>() noexcept;

} // namespace kernel
NUSSELT_NAMESPACE_END
