#pragma once
/// Spheres, disks, ellipses and ellipsoids.

#include "render_cpu/kernel/analytic.h"
#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/single_technique.h"
#include "render_cpu/lights/round_records.h"

#include <nusselt/cones/cone_clipped_solid_angle.h>
#include <nusselt/cones/cone_projected_solid_angle.h>
#include <nusselt/cones/cone_shading.h>
#include <nusselt/cones/cone_solid_angle.h>
#include <nusselt/cones/ellipse_area.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

inline const render_cpu::RoundRecord& round_record(const render_cpu::LightSet& lights,
                                                   std::int32_t index) noexcept {
    return static_cast<const render_cpu::RoundRecord*>(lights.records)[index];
}

/// The square of how high above the surface an axis reaches.
inline Real squared_height(const Vector& axis) noexcept { return axis.z * axis.z; }

// Lights in world space, and their highest points in shading space.

inline Sphere<float> world(const render_cpu::RoundRecord& record, const Sphere<float>*) noexcept {
    return {to_vec(record.center), record.radius};
}
inline Disk<float> world(const render_cpu::RoundRecord& record, const Disk<float>*) noexcept {
    return {to_vec(record.center), to_vec(record.normal), record.radius};
}
inline Ellipse<float> world(const render_cpu::RoundRecord& record, const Ellipse<float>*) noexcept {
    return {to_vec(record.center), to_vec(record.axis[0]), to_vec(record.axis[1])};
}
inline Ellipsoid<float> world(const render_cpu::RoundRecord& record, const Ellipsoid<float>*) noexcept {
    return {to_vec(record.center), {to_vec(record.axis[0]), to_vec(record.axis[1]), to_vec(record.axis[2])}};
}

inline Real highest_point(const Sphere<Real>& light) noexcept { return light.center.z + light.radius; }
inline Real highest_point(const Disk<Real>& light) noexcept {
    const Vec2<Real> across{light.normal.x, light.normal.y};
    return light.center.z + light.radius * sqrt(dot(across, across));
}
inline Real highest_point(const Ellipse<Real>& light) noexcept {
    return light.center.z + sqrt(squared_height(light.u) + squared_height(light.v));
}
inline Real highest_point(const Ellipsoid<Real>& light) noexcept {
    return light.center.z + sqrt(squared_height(light.axis[0]) + squared_height(light.axis[1]) +
                                 squared_height(light.axis[2]));
}

inline void scale(const Real& factor, Sphere<Real>& light) noexcept { light.radius = factor * light.radius; }
inline void scale(const Real& factor, Ellipsoid<Real>& light) noexcept {
    for (Vector& axis : light.axis) axis = factor * axis;
}

/// A vector in the space of the unit sphere of a solid light.
template <class R>
Vec3<R> in_unit_sphere(const render_cpu::RoundRecord& record, const Vec3<R>& v) noexcept {
    const auto row = [&](const scene::Float3& inverse) { return dot(broadcast<R>(to_vec(inverse)), v); };
    return {row(record.inverse[0]), row(record.inverse[1]), row(record.inverse[2])};
}

template <template <class> class Light>
inline constexpr bool kIsFlat = std::is_same_v<LightView<Light<Real>>, FlatLightView<Real>>;

/// A light in shading space.
template <template <class> class Light>
struct LocalRound : Light<Real> {
    const render_cpu::RoundRecord* record;
    LaneMask inside; ///< points that a solid light surrounds

    /// From inside, where all directions lead to the light, it is a little too large: see facing_lanes(). Shadow rays end where it
    /// really is.
    void modulate(const Surface& surface, DirectLightSample<Real>& sample) const noexcept {
        if constexpr (!kIsFlat<Light>) {
            if (!any(inside)) return;
            const Vector origin =
                in_unit_sphere(*record, surface.position - broadcast<Real>(to_vec(record->center)));
            const Vector direction = in_unit_sphere(*record, surface.frame.to_world(sample.wi));
            const Real a = dot(direction, direction);
            const Real half = dot(origin, direction);
            const Real distance = length(origin);
            const Real root = half * half - a * ((distance - Real(1)) * (distance + Real(1)));
            // No shorter, because a ray needs a direction. Along the surface, this is far less than what shadow rays
            // take for the same point.
            constexpr float kShortest = 1e-3f;
            const Real way = max(sqrt(max(root, Real(0))) - half, Real(kShortest) * sqrt(a));
            sample.p = select(inside, (way / a) * sample.wi, sample.p);
        }
    }
};

/// Finds the points that lie on a side that emits.
/// \param on_light points on the surface of the light
template <template <class> class Light>
LaneMask facing_lanes(const Surface& surface, LaneMask on_light, LocalRound<Light>& light) noexcept {
    const render_cpu::RoundRecord& record = *light.record;
    // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
    if constexpr (kIsFlat<Light>) {
        if (record.emits_inwards != 0) return !on_light;
        const Vector normal = surface.frame.to_local(broadcast<Real>(to_vec(record.normal)));
        return !on_light & !(dot(normal, light.center) >= Real(0));
    } else {
        const Vector unit = in_unit_sphere(record, surface.position - broadcast<Real>(to_vec(record.center)));
        // Rounding puts points on the light to either side of it: the normal towards the eye decides.
        const Vector normal = in_unit_sphere(record, surface.geometric_normal);
        const LaneMask faces_inwards = dot(normal, unit) < Real(0);
        light.inside = (on_light & faces_inwards) | (!on_light & (dot(unit, unit) < Real(1)));
        const LaneMask outside = !on_light & !light.inside;
        if (record.emits_inwards == 0) return outside;
        // A little larger, so that those points are inside.
        constexpr float kMargin = 1.001f;
        scale(select(light.inside, Real(kMargin), Real(1)), light);
        return record.emits_outwards != 0 ? outside | light.inside : light.inside;
    }
}

/// A kind of light as point_samples.h describes it. \tparam Light of the library
template <template <class> class Light>
struct RoundLight {
    using Shape = LocalRound<Light>;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::RoundRecord& record = round_record(lights, index);
        const Surface& surface = reflected.surface();
        Shape shape{to_shading_space(world(record, static_cast<const Light<float>*>(nullptr)),
                                     surface.position, surface.frame),
                    &record, LaneMask(false)};
        const std::int32_t number = lights.first + index;
        LaneMask lit = reflected.lanes() & facing_lanes<Light>(surface, reflected.on_light(number), shape);
        lit &= !(highest_point(shape) <= Real(0));
        return {shape, lit, broadcast<Real>(to_vec(record.radiance)), static_cast<std::uint32_t>(number)};
    }

    /// By area where that is a technique, else by solid angle.
    static auto technique(TechniqueTag<render::Technique::area>, const Shape& shape) noexcept {
        if constexpr (kIsFlat<Light>)
            return EllipseArea<Real, Light>(shape);
        else
            return ConeSolidAngle<Real, Light>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::solid_angle>, const Shape& shape) noexcept {
        return ConeSolidAngle<Real, Light>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::clipped_solid_angle>, const Shape& shape) noexcept {
        return ConeClippedSolidAngle<Real, Light>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::projected_solid_angle>,
                          const Shape& shape) noexcept {
        return ConeProjectedSolidAngle<Real, Light>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::projected_solid_angle_biased>,
                          const Shape& shape) noexcept {
        return ConeProjectedSolidAngle<Real, Light>(shape);
    }

    static LobeIntegrals integrals(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        return {round_diffuse_integral<Real, Light>(shape), round_lobe_integral<Real, Light>(shape, lobe)};
    }
};

/// The functions that take points of such lights as a job demands.
render_cpu::AddLight sphere_points(const render_cpu::RenderJob& job) noexcept;
render_cpu::AddLight disk_points(const render_cpu::RenderJob& job) noexcept;
render_cpu::AddLight ellipse_points(const render_cpu::RenderJob& job) noexcept;
render_cpu::AddLight ellipsoid_points(const render_cpu::RenderJob& job) noexcept;

} // namespace kernel
NUSSELT_NAMESPACE_END
