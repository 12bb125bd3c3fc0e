#pragma once
/// What the published methods for spheres by projected solid angle share: the cap of a sphere, projected to the surface. It is an
/// ellipse, or what is left of it above the horizon together with a segment of the unit disk.

#include <nusselt/cones/cycloid.h>
#include <nusselt/cones/round_lights.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack.
template <class Real>
struct ProjectedCap {
    using Scalar = scalar_t<Real>;

    Vec3<Real> center; ///< scaled to an extent of order one
    Real radius, inverse_scale;
    Vec2<Real>
        across; ///< unit, towards the light in the plane of the surface; the other axis is perpendicular to it
    Vec2<Real> axis;   ///< of the cap: along across, and up
    Real sine, cosine; ///< of the half-angle of the cap
    Real middle;       ///< of the ellipse, along across
    Vec2<Real> half;   ///< extents of the ellipse, the first one negative if the centre is below the horizon
    Real cut;          ///< where the plane of the cap's rim meets the horizon; 1 and more: it does not
    mask_t<Real> is_lit; ///< outside of the sphere, and something is above the horizon

    ProjectedCap() = default;

    /// \param light in shading space [m].
    NUSSELT_HD explicit ProjectedCap(const Sphere<Real>& light) noexcept {
        const Real scale =
            reciprocal_power_of_two(max(detail::largest_component(light.center), light.radius));
        center = scale * light.center;
        radius = scale * light.radius;
        inverse_scale = reciprocal_power_of_two(scale);
        const Real distance = length(center);
        const Real inverse = detail::over_positive(Real(1), distance);
        const Real lateral = detail::hypotenuse(center.x, center.y);
        const auto tilted = lateral > Real(0);
        const Real inverse_lateral = Real(1) / select(tilted, lateral, Real(1));
        across = {select(tilted, center.x * inverse_lateral, Real(1)),
                  select(tilted, center.y * inverse_lateral, Real(0))};
        axis = {lateral * inverse, center.z * inverse};
        sine = min(radius * inverse, Real(1));
        cosine = sqrt(max((distance - radius) * (distance + radius), Real(0))) * inverse;
        middle = cosine * axis.x;
        half = {sine * axis.y, sine};
        cut = select(cosine < axis.x, cosine / select(tilted, axis.x, Real(1)), Real(1));
        const auto above = (axis.y > Real(0)) | (cut < Real(1));
        is_lit = (radius > Real(0)) & (distance > radius) & above;
    }

    template <class Single>
    NUSSELT_HD explicit ProjectedCap(const ProjectedCap<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param p in the plane of the surface.
    NUSSELT_HD Vec3<Real> direction(const Vec2<Real>& p, const Real& height) const noexcept {
        return {p.x * across.x - p.y * across.y, p.x * across.y + p.y * across.x, height};
    }
    NUSSELT_HD Vec2<Real> projected(const Vec3<Real>& wi) const noexcept {
        return {wi.x * across.x + wi.y * across.y, wi.y * across.x - wi.x * across.y};
    }
    /// The distance of the sphere along a direction [m].
    NUSSELT_HD Real distance(const Vec3<Real>& wi) const noexcept {
        const Real along = dot(wi, center);
        const Vec3<Real> off = center - along * wi;
        const Real root = sqrt(max(radius * radius - dot(off, off), Real(0)));
        const Real far = length(center);
        return inverse_scale * detail::over_positive((far - radius) * (far + radius), along + root);
    }

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.center, self.radius, self.inverse_scale, self.across, self.axis, self.sine, self.cosine,
              self.middle, self.half, self.cut, self.is_lit);
    }
};

NUSSELT_NAMESPACE_END
