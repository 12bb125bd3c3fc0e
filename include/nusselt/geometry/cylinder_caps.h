#pragma once
/// Tells the caps of a cylinder from its lateral surface.

#include <nusselt/geometry/cylinder.h>

NUSSELT_NAMESPACE_BEGIN

/// Whether a ray from the origin that meets a closed cylinder from outside meets a cap first: what an open tube, which emits
/// from its lateral surface only, does not fill with light.
/// \param wi of any length.
/// Next to the rim of a cap, rounding decides. False inside the slab between the planes of the caps.
template <class Real>
NUSSELT_HD inline mask_t<Real> meets_cap(const Cylinder<Real>& cylinder, const Vec3<Real>& wi) noexcept {
    const LineSegment<Real>& axis = cylinder.axis;
    const Real l0 = dot(axis.p0, axis.s);
    const Real l1 = l0 + axis.length;
    const auto before = l0 > Real(0);
    const Real l = select(before, l0, l1);
    const Real along = dot(wi, axis.s);
    // The ray reaches the plane of the cap after l / along; all lengths here are those times |along|.
    const Vec3<Real> from_centre = l * wi - along * select(before, axis.p0, end_of(axis));
    const auto ahead = (before & (along > Real(0))) | ((l1 < Real(0)) & (along < Real(0)));
    return ahead & (length(from_centre) < cylinder.radius * abs(along));
}

NUSSELT_NAMESPACE_END
