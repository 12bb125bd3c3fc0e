#pragma once
/// Spheres, disks, ellipses and ellipsoids as lights, and what a point sees of them: an elliptic cone, and the way from
/// a point of its disk back to the light.

#include <utility>

#include <nusselt/cones/elliptic_cone.h>
#include <nusselt/geometry/scaled_light.h>

NUSSELT_NAMESPACE_BEGIN

/// A sphere. From inside, all directions lead to it.
template <class Real>
struct Sphere {
    Vec3<Real> center; ///< [m]
    Real radius;       ///< [m]
};

/// A circular disk; both sides are the same to techniques.
template <class Real>
struct Disk {
    Vec3<Real> center; ///< [m]
    Vec3<Real> normal; ///< unit
    Real radius;       ///< [m]
};

/// The points center + sigma u + tau v with sigma^2 + tau^2 <= 1.
template <class Real>
struct Ellipse {
    Vec3<Real> center; ///< [m]
    Vec3<Real> u, v;   ///< conjugate semi-diameters, which need not be perpendicular [m]
};

/// The points center + x axis[0] + y axis[1] + z axis[2] with x^2 + y^2 + z^2 <= 1. From inside, all directions lead to
/// it.
template <class Real>
struct Ellipsoid {
    Vec3<Real> center;  ///< [m]
    Vec3<Real> axis[3]; ///< conjugate semi-diameters, which need not be perpendicular [m]
};

/// \copydoc to_shading_space(const Cylinder<LightReal>&, const Vec3<Real>&, const Frame<Real>&)
template <class Real, class LightReal>
NUSSELT_INLINE Sphere<Real> to_shading_space(const Sphere<LightReal>& world, const Vec3<Real>& point,
                                             const Frame<Real>& frame) noexcept {
    return {frame.to_local(broadcast<Real>(world.center) - point), Real(world.radius)};
}
template <class Real, class LightReal>
NUSSELT_INLINE Disk<Real> to_shading_space(const Disk<LightReal>& world, const Vec3<Real>& point,
                                           const Frame<Real>& frame) noexcept {
    return {frame.to_local(broadcast<Real>(world.center) - point),
            frame.to_local(broadcast<Real>(world.normal)), Real(world.radius)};
}
template <class Real, class LightReal>
NUSSELT_INLINE Ellipse<Real> to_shading_space(const Ellipse<LightReal>& world, const Vec3<Real>& point,
                                              const Frame<Real>& frame) noexcept {
    return {frame.to_local(broadcast<Real>(world.center) - point), frame.to_local(broadcast<Real>(world.u)),
            frame.to_local(broadcast<Real>(world.v))};
}
template <class Real, class LightReal>
NUSSELT_INLINE Ellipsoid<Real> to_shading_space(const Ellipsoid<LightReal>& world, const Vec3<Real>& point,
                                                const Frame<Real>& frame) noexcept {
    const auto local = [&](const Vec3<LightReal>& a) { return frame.to_local(broadcast<Real>(a)); };
    return {frame.to_local(broadcast<Real>(world.center) - point),
            {local(world.axis[0]), local(world.axis[1]), local(world.axis[2])}};
}

namespace detail {

template <class Real>
NUSSELT_INLINE Real largest_component(const Vec3<Real>& v) noexcept {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// Leaves vectors as they are, where a lobe would take them to its cosine space.
struct SameSpace {
    template <class Real>
    NUSSELT_HD const Vec3<Real>& operator()(const Vec3<Real>& v) const noexcept {
        return v;
    }
};

} // namespace detail

/// An ellipse or a disk as the origin sees it.
template <class Real>
struct FlatLightView {
    EllipticCone<Real> cone; ///< in the space to which the map leads
    Vec3<Real> center, u, v; ///< in shading space, scaled to an extent of order one
    Real inverse_scale;      ///< a power of two

    /// Whether the light surrounds the origin: never.
    NUSSELT_HD static mask_t<Real> is_open() noexcept { return mask_t<Real>(false); }

    /// The point of the light that belongs to a point of the disk of the cone [m].
    NUSSELT_HD Vec3<Real> point(const Vec2<Real>& disk, const Vec3<Real>&) const noexcept {
        const Vec2<Real> p = cone.to_light(disk);
        return center + (p.x * u + p.y * v);
    }

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.cone, self.center, self.u, self.v, self.inverse_scale);
    }
};

/// An ellipsoid or a sphere as the origin sees it. In the space of the unit sphere, its tangent cone touches a circle.
template <class Real>
struct SolidLightView {
    EllipticCone<Real> cone;
    Vec3<Real> center, w, u,
        v; ///< w leads to the centre in the space of the unit sphere, u and v are perpendicular to w there
    Vec3<Real> inverse[3]; ///< rows of the inverse of (w u v), for rays from inside
    Real closeness;        ///< one over the distance of the centre in the space of the unit sphere
    Real rim;              ///< sqrt(1 - closeness^2)
    mask_t<Real> is_inside;
    Real inverse_scale; ///< a power of two

    /// Whether the light surrounds the origin.
    NUSSELT_HD const mask_t<Real>& is_open() const noexcept { return is_inside; }

    /// The point of the light that belongs to a point of the disk of the cone, the closer one of two; from inside,
    /// where a ray leaves the light [m]. Tiny and near lights do not cancel.
    NUSSELT_HD Vec3<Real> point(const Vec2<Real>& disk, const Vec3<Real>& wi) const noexcept {
        const Vec2<Real> p = cone.to_light(disk);
        const Real kappa = sqrt(max(Real(1) - dot(p, p), Real(0)));
        const Real inverse_sum = Real(1) / (Real(1) + kappa * closeness);
        const Real back = (closeness + kappa) * inverse_sum;
        const Real lateral = rim * inverse_sum;
        const Vec3<Real> outside = center + ((lateral * p.x) * u + (lateral * p.y) * v - back * w);
        if (!any(is_inside)) return outside;
        // |t d - y| = 1 with the direction d and the centre y in the space of the unit sphere.
        const Vec3<Real> d{dot(inverse[0], wi), dot(inverse[1], wi), dot(inverse[2], wi)};
        const Real y = Real(1) / select(is_inside, max(closeness, Real(1)), Real(1));
        const Real squared = dot(d, d);
        const Real half = d.x * y;
        const Real root =
            sqrt(max(multiply_add(half, half, squared * ((Real(1) - y) * (Real(1) + y))), Real(0)));
        // Rounding next to a flat light must not lead far away.
        const Real farthest = length(center) + length(w) + length(u) + length(v);
        const Real t = min(detail::over_positive(root + half, squared), farthest);
        return select(is_inside, t * wi, outside);
    }

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.cone, self.center, self.w, self.u, self.v, self.inverse, self.closeness, self.rim,
              self.is_inside, self.inverse_scale);
    }
};

template <class Real, class Single>
NUSSELT_INLINE FlatLightView<Real> broadcast(const FlatLightView<Single>& view) noexcept {
    FlatLightView<Real> result;
    broadcast_members<Real>(result, view);
    return result;
}
template <class Real, class Single>
NUSSELT_INLINE SolidLightView<Real> broadcast(const SolidLightView<Single>& view) noexcept {
    SolidLightView<Real> result;
    broadcast_members<Real>(result, view);
    return result;
}

/// \tparam Map a linear map with which the cone is seen, or detail::SameSpace.
template <class Real, class Map>
NUSSELT_HD inline FlatLightView<Real> view_of(const Ellipse<Real>& light, const Map& map) noexcept {
    const Real extent = max(max(detail::largest_component(light.center), detail::largest_component(light.u)),
                            detail::largest_component(light.v));
    const Real scale = reciprocal_power_of_two(extent);
    FlatLightView<Real> view;
    view.center = scale * light.center;
    view.u = scale * light.u;
    view.v = scale * light.v;
    view.inverse_scale = reciprocal_power_of_two(scale);
    const Vec3<Real> centre = map(view.center);
    view.cone = cone_of_ellipse(map(view.u), map(view.v), centre, centre);
    return view;
}

/// \copydoc view_of(const Ellipse<Real>&, const Map&)
template <class Real, class Map>
NUSSELT_HD inline FlatLightView<Real> view_of(const Disk<Real>& light, const Map& map) noexcept {
    const Real scale = reciprocal_power_of_two(max(detail::largest_component(light.center), light.radius));
    FlatLightView<Real> view;
    view.center = scale * light.center;
    view.inverse_scale = reciprocal_power_of_two(scale);
    const Real radius = scale * light.radius;
    if constexpr (std::is_same_v<Map, detail::SameSpace>) {
        const DiskCone<Real> disk = cone_of_disk(view.center, light.normal, radius);
        view.cone = disk.cone;
        view.u = disk.u;
        view.v = disk.v;
    } else {
        const Frame<Real> frame = Frame<Real>::from_normal(light.normal);
        view.u = radius * frame.t;
        view.v = radius * frame.b;
        const Vec3<Real> centre = map(view.center);
        view.cone = cone_of_ellipse(map(view.u), map(view.v), centre, centre);
    }
    return view;
}

namespace detail {

/// From inside, the light fills all directions: the cone is the upper half-space.
template <class Real>
NUSSELT_HD inline void open_from_inside(SolidLightView<Real>& view) noexcept {
    const Real zero = Real(0), one = Real(1);
    const auto in = view.is_inside;
    EllipticCone<Real>& cone = view.cone;
    cone.e1 = select(in, Vec3<Real>{one, zero, zero}, cone.e1);
    cone.e2 = select(in, Vec3<Real>{zero, one, zero}, cone.e2);
    cone.e3 = select(in, Vec3<Real>{zero, zero, one}, cone.e3);
    cone.a = select(in, one, cone.a);
    cone.b = select(in, one, cone.b);
    cone.c = select(in, zero, cone.c);
}

} // namespace detail

/// \copydoc view_of(const Ellipse<Real>&, const Map&)
template <class Real, class Map>
NUSSELT_HD inline SolidLightView<Real> view_of(const Sphere<Real>& light, const Map& map) noexcept {
    const Real scale = reciprocal_power_of_two(max(detail::largest_component(light.center), light.radius));
    SolidLightView<Real> view;
    view.center = scale * light.center;
    view.inverse_scale = reciprocal_power_of_two(scale);
    const Real radius = scale * light.radius;
    const Real distance = length(view.center);
    view.is_inside = distance < radius;
    const Real safe = select(distance > Real(0), distance, Real(1));
    const Frame<Real> frame = Frame<Real>::from_normal(
        select(distance > Real(0), normalize(view.center), Vec3<Real>{Real(0), Real(0), Real(1)}));
    view.closeness = radius / max(distance, Real(std::numeric_limits<scalar_t<Real>>::min()));
    view.rim = sqrt(max((distance - radius) * (distance + radius), Real(0))) / safe;
    view.w = radius * frame.n;
    view.u = radius * frame.t;
    view.v = radius * frame.b;
    const Real inverse = detail::over_positive(Real(1), radius);
    view.inverse[0] = inverse * frame.n;
    view.inverse[1] = inverse * frame.t;
    view.inverse[2] = inverse * frame.b;
    if constexpr (std::is_same_v<Map, detail::SameSpace>)
        view.cone = cone_of_circle(frame, min(view.closeness, Real(1)), view.rim);
    else
        view.cone = cone_of_ellipse(map(view.u), map(view.v), map(view.rim * view.center), map(view.center));
    view.cone.is_visible = view.cone.is_visible & (radius > Real(0));
    if (any(view.is_inside)) detail::open_from_inside(view);
    return view;
}

/// \copydoc view_of(const Ellipse<Real>&, const Map&)
/// An ellipsoid without volume is invisible.
template <class Real, class Map>
NUSSELT_HD inline SolidLightView<Real> view_of(const Ellipsoid<Real>& light, const Map& map) noexcept {
    const Real size =
        max(max(detail::largest_component(light.axis[0]), detail::largest_component(light.axis[1])),
            detail::largest_component(light.axis[2]));
    const Real scale = reciprocal_power_of_two(max(detail::largest_component(light.center), size));
    SolidLightView<Real> view;
    view.center = scale * light.center;
    view.inverse_scale = reciprocal_power_of_two(scale);

    // Find the centre in the space of the unit sphere. Axes of order one keep the determinant in range.
    const Real up = reciprocal_power_of_two(size);
    const Vec3<Real> a = up * light.axis[0], b = up * light.axis[1], c = up * light.axis[2];
    const Vec3<Real> bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const Real volume = dot(a, bc);
    // Of coplanar semi-diameters, the volume is a matter of rounding.
    const Real terms = abs(a.x * bc.x) + abs(a.y * bc.y) + abs(a.z * bc.z);
    const auto solid = abs(volume) > max(Real(4 * std::numeric_limits<scalar_t<Real>>::epsilon()) * terms,
                                         Real(kTiny<scalar_t<Real>>));
    const Real inverse_volume = Real(1) / select(solid, volume, Real(1));
    const Vec3<Real> unit{inverse_volume * dot(bc, view.center), inverse_volume * dot(ca, view.center),
                          inverse_volume * dot(ab, view.center)};
    const Real down = scale / up; // how large the axes are; a power of two
    const Real distance = length(unit);
    view.is_inside = solid & (distance < down);
    const auto centred = !(distance > Real(0));
    const Real safe = select(centred, Real(1), distance);
    const Frame<Real> frame =
        Frame<Real>::from_normal(select(centred, Vec3<Real>{Real(0), Real(0), Real(1)}, normalize(unit)));
    view.closeness = down / max(distance, Real(std::numeric_limits<scalar_t<Real>>::min()));
    view.rim = sqrt(max((distance - down) * (distance + down), Real(0))) / safe;
    const auto to_light = [&](const Vec3<Real>& x) { return down * (x.x * a + (x.y * b + x.z * c)); };
    view.w = to_light(frame.n);
    view.u = to_light(frame.t);
    view.v = to_light(frame.b);
    const Real inverse = inverse_volume / select(down > Real(0), down, Real(1));
    const auto row = [&](const Vec3<Real>& x) { return inverse * (x.x * bc + (x.y * ca + x.z * ab)); };
    view.inverse[0] = row(frame.n);
    view.inverse[1] = row(frame.t);
    view.inverse[2] = row(frame.b);
    view.cone = cone_of_ellipse(map(view.u), map(view.v), map(view.rim * view.center), map(view.center));
    view.cone.is_visible = view.cone.is_visible & solid;
    if (any(view.is_inside)) detail::open_from_inside(view);
    return view;
}

/// How the origin sees a light: FlatLightView or SolidLightView.
template <class Light>
using LightView = decltype(view_of(std::declval<const Light&>(), detail::SameSpace()));

NUSSELT_NAMESPACE_END
