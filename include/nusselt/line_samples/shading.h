#pragma once
/// What parts of the lines of a planar light contribute to diffuse and glossy surfaces, in closed form.
///
/// Along a line, the cosine at the light over the distance is constant up to one more cosine: a part of a line is a
/// linear light, times half the cosine at the light in the closest point of the infinite line. So the integrals per
/// radius of linear lights do it all (Billen and Dutre 2016, Eq. 20, in the end-point form of clip_line.h; the printed
/// equation cancels for short and distant parts, and has an error).
///
/// All functions return radiance per metre of offset for a light of radiance 1 and a lobe of albedo 1 [1/m]: the
/// integral over the offsets, for visible parts, is the radiance that is reflected. They are accurate relative to
/// themselves, apart from what the rounding of the light's position relative to the shading point does.

#include <nusselt/line_samples/line_family.h>
#include <nusselt/ltc/line_shading.h>

NUSSELT_NAMESPACE_BEGIN

/// Lights that shine where their normal points to.
struct FrontSide {
    template <class Real>
    NUSSELT_HD static Real lit(const Real& cosine) noexcept {
        return max(cosine, Real(0));
    }
};

/// Lights that shine to both sides.
struct BothSides {
    template <class Real>
    NUSSELT_HD static Real lit(const Real& cosine) noexcept {
        return abs(cosine);
    }
};

/// Signed distance of the plane of a light from the origin [m], positive if the normal points away from it; 0 if it cannot
/// be told from rounding.
template <class Real>
NUSSELT_HD inline Real plane_distance(const LinePlane<Real>& plane) noexcept {
    const Vec3<Real> product{plane.origin.x * plane.normal.x, plane.origin.y * plane.normal.y,
                             plane.origin.z * plane.normal.z};
    const Real distance = product.x + product.y + product.z;
    const Real rounding = Real(4 * std::numeric_limits<scalar_t<Real>>::epsilon()) *
                          (abs(product.x) + abs(product.y) + abs(product.z));
    return select(abs(distance) > rounding, distance, Real(0));
}

/// Cosine between the normal of a light and the direction from the point of an infinite line that is closest to the
/// origin to the origin; negative behind the light, 0 if the plane cannot be told from one through the origin.
/// \param plane as seen from a shading point [m].
template <class Real>
NUSSELT_HD inline Real cosine_at_light(const LinePlane<Real>& plane, const Real& offset) noexcept {
    const Real height = plane_distance(plane);
    const Real aside = dot(plane.origin, plane.across) + offset;
    const Vec3<Real> closest{height, aside, Real(0)};
    return -normalize(closest).x;
}

/// What a part of a line contributes to a Lambertian surface.
/// \tparam Sides FrontSide or BothSides.
/// \param plane in shading space [m].
/// \param part  of the line at the offset.
template <class Sides = FrontSide, class Real>
NUSSELT_HD inline Real diffuse_part(const LinePlane<Real>& plane, const Real& offset,
                                    const Interval<Real>& part) noexcept {
    return Real(0.5) * Sides::lit(cosine_at_light(plane, offset)) *
           diffuse_integral(segment_of(plane, offset, part));
}

/// What a part of a line contributes to a glossy surface.
/// \tparam Horizons CosineHorizon, or BothHorizons where light below the surface shall not count.
/// \tparam Sides    FrontSide or BothSides.
/// \param plane in shading space with wo in the xz half-plane [m].
template <class Horizons = BothHorizons, class Sides = FrontSide, class Real>
NUSSELT_HD inline Real lobe_part(const LinePlane<Real>& plane, const Real& offset, const Interval<Real>& part,
                                 const Ltc<Real>& ltc) noexcept {
    return Real(0.5) * Sides::lit(cosine_at_light(plane, offset)) *
           lobe_integral<Horizons>(segment_of(plane, offset, part), ltc);
}

NUSSELT_NAMESPACE_END
