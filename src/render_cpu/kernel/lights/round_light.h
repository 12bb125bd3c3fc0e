#pragma once
/// Spheres, disks, ellipses and ellipsoids.

#include "render_cpu/kernel/analytic.h"
#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/single_technique.h"
#include "render_cpu/lights/round_records.h"

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

inline void shrink(const Real& share, Sphere<Real>& light) noexcept { light.radius = share * light.radius; }
inline void shrink(const Real& share, Ellipsoid<Real>& light) noexcept {
    for (Vector& axis : light.axis) axis = share * axis;
}

/// The squared distance of points from the centre, in the space of the unit sphere. \param p in world space
template <class R>
R squared_distance_inside(const render_cpu::RoundRecord& record, const Vec3<R>& p) noexcept {
    const Vec3<R> offset = p - broadcast<R>(to_vec(record.center));
    const auto row = [&](const scene::Float3& inverse) { return dot(broadcast<R>(to_vec(inverse)), offset); };
    const Vec3<R> unit{row(record.inverse[0]), row(record.inverse[1]), row(record.inverse[2])};
    return dot(unit, unit);
}

/// The points that lie on a side that emits. From inside a solid light, its surface moves inwards into the triangles of the
/// scene, which shadow rays would hit. Points between both are dark.
template <template <class> class Light>
LaneMask facing_lanes(const render_cpu::RoundRecord& record, const Surface& surface,
                      Light<Real>& light) noexcept {
    // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
    if constexpr (std::is_same_v<LightView<Light<Real>>, FlatLightView<Real>>) {
        if (record.emits_inwards != 0) return LaneMask(true);
        const Vector normal = surface.frame.to_local(broadcast<Real>(to_vec(record.normal)));
        return !(dot(normal, light.center) >= Real(0));
    } else {
        const Real squared = squared_distance_inside(record, surface.position);
        const LaneMask outside = !(squared < Real(1));
        const LaneMask inside = squared < Real(record.shell * record.shell);
        if (record.emits_inwards == 0) return outside;
        shrink(select(outside, Real(1), Real(record.shell)), light);
        return record.emits_outwards != 0 ? outside | inside : inside;
    }
}

/// A kind of light as point_samples.h describes it. \tparam Light of the library
template <template <class> class Light>
struct RoundLight {
    using Shape = Light<Real>;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::RoundRecord& record = round_record(lights, index);
        const Surface& surface = reflected.surface();
        Shape shape = to_shading_space(world(record, static_cast<const Light<float>*>(nullptr)),
                                       surface.position, surface.frame);
        const std::int32_t number = lights.first + index;
        // A convex light does not light itself, but its triangles lie behind its surface.
        LaneMask lit = reflected.lanes() & !reflected.on_light(number);
        lit &= facing_lanes<Light>(record, surface, shape);
        lit &= !(highest_point(shape) <= Real(0));
        return {shape, lit, broadcast<Real>(to_vec(record.radiance)), static_cast<std::uint32_t>(number)};
    }

    /// By area where that is a technique, else by solid angle.
    static auto technique(TechniqueTag<render::Technique::area>, const Shape& shape) noexcept {
        if constexpr (std::is_same_v<LightView<Shape>, FlatLightView<Real>>)
            return EllipseArea<Real, Light>(shape);
        else
            return ConeSolidAngle<Real, Light>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::solid_angle>, const Shape& shape) noexcept {
        return ConeSolidAngle<Real, Light>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::clipped_solid_angle>, const Shape& shape) noexcept {
        return ConeSolidAngle<Real, Light>(shape);
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
