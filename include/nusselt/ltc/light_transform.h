#pragma once
/// Lights in the cosine space of a lobe. A linear map takes polygons to polygons and segments to segments, and the
/// integral of the lobe over the light to that of the clamped cosine over its image.

#include <nusselt/geometry/clip_line.h>
#include <nusselt/geometry/polygon_part.h>
#include <nusselt/ltc/ltc.h>

NUSSELT_NAMESPACE_BEGIN

/// \param light in shading space, with coordinates of order one (with_unit_extent()).
template <class Real, int N>
NUSSELT_HD inline ConvexPolygon<Real, N> to_cosine_space(const ConvexPolygon<Real, N>& light,
                                                         const Ltc<Real>& ltc) noexcept {
    ConvexPolygon<Real, N> image;
    NUSSELT_UNROLL
    for (int j = 0; j < N; ++j) {
        image.vertex[j] = ltc.to_cosine(light.vertex[j]);
        image.edge[j] = ltc.to_cosine(light.edge[j]);
    }
    image.normal = normalize(ltc.normal_to_cosine(light.normal));
    return image;
}

/// \param light in shading space, with coordinates of order one (scaled()).
template <class Real>
NUSSELT_HD inline LineSegment<Real> to_cosine_space(const LineSegment<Real>& light,
                                                    const Ltc<Real>& ltc) noexcept {
    const Vec3<Real> s = ltc.to_cosine(light.s);
    const Real stretch = length(s);
    const Real inverse = Real(1) / select(stretch > Real(0), stretch, Real(1));
    return {ltc.to_cosine(light.p0), inverse * s, stretch * light.length};
}

/// dR / dR_c: how much thicker a thin tube is in shading space than its image (Peters 2021, linear lights, Eq. 5, the
/// reciprocal of the width factor of Heitz and Hill 2017, Linear-Light Shading with Linearly Transformed Cosines).
/// \param moment cross product of a point and the direction of the line in shading space, of any length.
/// \returns 0 for the zero vector.
template <class Real>
NUSSELT_HD inline Real radius_ratio(const Vec3<Real>& moment, const Ltc<Real>& ltc) noexcept {
    return length(ltc.normal_to_cosine(normalize(moment))) / ltc.minor();
}

/// Counts the part of a light that the lobe reaches, as published (Peters 2021, polygonal lights, Sec.
/// 4.1): lobes also reach below the surface, but seldom.
struct CosineHorizon {
    /// Bound on the number of vertices for polygons with at most N.
    template <int N>
    static constexpr int kVertices = N;

    template <class Real, int N>
    NUSSELT_HD static PolygonPart<Real, N> part_of(const ConvexPolygon<Real, N>& light) noexcept {
        return whole_part(light);
    }
    /// The polygon of part_of() alone, for integrals, which do not need its plane.
    template <class Real, int N>
    NUSSELT_HD static ConvexPolygon<Real, N> outline_of(const ConvexPolygon<Real, N>& light) noexcept {
        return with_unit_extent(light);
    }
    template <class Real>
    NUSSELT_HD static LineSegment<Real> part_of(const LineSegment<Real>& light) noexcept {
        return light;
    }
    /// A point of the part, or a vector towards it: it may lie below the surface.
    template <class Real>
    NUSSELT_HD static Vec3<Real> lifted(const Vec3<Real>& p) noexcept {
        return p;
    }
};

/// Counts the part of a light that the lobe reaches and that is above the surface too.
struct BothHorizons {
    /// \copydoc CosineHorizon::kVertices
    template <int N>
    static constexpr int kVertices = N + 1;

    template <class Real, int N>
    NUSSELT_HD static PolygonPart<Real, N + 1> part_of(const ConvexPolygon<Real, N>& light) noexcept {
        return part_above_horizon(light);
    }
    /// \copydoc CosineHorizon::outline_of
    template <class Real, int N>
    NUSSELT_HD static ConvexPolygon<Real, N + 1> outline_of(const ConvexPolygon<Real, N>& light) noexcept {
        return with_unit_extent(clip_to_horizon(with_unit_extent(light)));
    }
    template <class Real>
    NUSSELT_HD static LineSegment<Real> part_of(const LineSegment<Real>& light) noexcept {
        CenteredLine<Real> part = centered(to_safe_extent(light));
        clip_to_horizon(part);
        const Vec3<Real> far = fma(part.length, part.inward, part.near);
        Vec3<Real> start = select(part.sign > Real(0), part.near, far);
        start.z = max(start.z, Real(0));
        return {start, light.s, part.length};
    }
    /// A point of the part, or a vector towards it, lifted to the surface if rounding moved it below.
    template <class Real>
    NUSSELT_HD static Vec3<Real> lifted(const Vec3<Real>& p) noexcept {
        return {p.x, p.y, max(p.z, Real(0))};
    }
};

NUSSELT_NAMESPACE_END
