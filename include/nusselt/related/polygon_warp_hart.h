#pragma once
/// A published method, to compare with: solid angle sampling of a polygon with random numbers that are warped to follow the
/// cosine at the surface.
///
/// D. Hart, M. Pharr, T. Müller, W. Lopes, M. McGuire, P. Shirley 2020, Practical Product Sampling by Fitting and Composing
/// Warps, CGF 39(4), doi:10.1111/cgf.14060. For polygons on top of a fan, with or without clipping, as C. Peters 2021, BRDF
/// Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672, Sec. 6.2 compares it. The density is a
/// bilinear or biquadratic function of the random numbers, with the cosines, clamped to 0, of four or nine points as control
/// values. Those of the four corners are known from the vertices.
///
/// Use PolygonProjectedSolidAngle instead: its density is the cosine. Known failures of this one:
/// - Only vertex 0, its two neighbours and, with the biquadratic warp, four points between vertices have influence. If
///   only other parts of the light are above the horizon, the warp is the identity.
/// - The variance depends on which vertex is the first. Clipping changes that vertex and the order of the others, so
///   that the variance jumps where a vertex crosses the horizon.
/// - Where vertex 0 is on the horizon, as often after clipping, the cosine grows with the square root of the distance
///   in y and the density with the distance: weights grow without bound, although their variance is finite.
/// - pdf(wi) inverts the map to random numbers, which are inaccurate next to vertex 0 and for lights seen edge-on. There
///   it deviates from the density of the sample.

#include <nusselt/related/hart_warps.h>
#include <nusselt/sampling/polygon_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace hart {

/// Cosines at the surface, or 0 below the horizon, of the corners of the map from random numbers to directions.
template <class Real, int N>
NUSSELT_HD inline FanCorners<Real> corner_cosines(const ConvexPolygon<Real, N>& light,
                                                  const PolygonSolidAngle<Real, N>&) noexcept {
    const auto cosine = [&](int j) { return max(normalize(light.vertex[j]).z, Real(0)); };
    return {cosine(0), cosine(1), cosine(N - 1)};
}

/// Of the clipped light, whose new vertices are on the horizon.
template <class Real, int N>
NUSSELT_HD inline FanCorners<Real> corner_cosines(const ConvexPolygon<Real, N>& light,
                                                  const PolygonClippedSolidAngle<Real, N>&) noexcept {
    const auto cosine = [&](int j) { return max(normalize(light.vertex[j]).z, Real(0)); };
    FanCorners<Real> corners{cosine(0), cosine(1), cosine(N - 1)};
    const auto begins_below = light.vertex[0].z <= Real(0);
    if (!any(begins_below)) return corners;
    // The fan begins where the boundary goes below the horizon, if it does so between the last vertex and the first one; the
    // next vertex is then the one where it comes up again. Otherwise, the fan begins where it comes up, and the first
    // vertex above the horizon is next.
    Real first = Real(0);
    for (int j = N - 2; j > 0; --j) first = select(light.vertex[j].z > Real(0), cosine(j), first);
    const auto begins_going_down = light.vertex[N - 1].z > Real(0);
    corners.first = select(begins_below, select(begins_going_down, Real(0), first), corners.first);
    return corners;
}

} // namespace hart

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per lane.
/// \tparam N    bound on the number of vertices, 3 to 8, or 9 without clipping.
/// \tparam Warp hart::BilinearWarp or hart::BiquadraticWarp.
/// \tparam Base the technique below: PolygonSolidAngle or PolygonClippedSolidAngle.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: that of the base times that of the warp.
/// Space: shading space. With PolygonSolidAngle nothing is clipped, so that wi may point below the horizon.
/// Edge cases: no area, or origin in the plane of the polygon: pdf = 0, measure 0. All cosines 0: the density of the base.
/// u.y = 0 where vertex 0 is not above the horizon: pdf = 0.
template <class Real, int N, template <class> class Warp, template <class, int> class Base>
class PolygonWarpHart {
public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit PolygonWarpHart(const ConvexPolygon<Real, N>& light) noexcept
        : base_(light), warp_(Warp<Real>::fit(hart::corner_cosines(light, base_), CosineOf{base_})) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonWarpHart(const PolygonWarpHart<Single, N, Warp, Base>& single) noexcept
        : base_(single.base_), warp_(single.warp_) {}

    /// \param u in [0, 1)^2, see PolygonSolidAngle::sample().
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vec2<Real> x = warp_.sample(u);
        LightSample<Real> s = base_.sample(x);
        s.pdf = finite(warp_.density(x) * s.pdf);
        return s;
    }

    /// \param wi a unit direction on the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        return finite(warp_.density(base_.invert(wi)) * base_.pdf(wi));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        return warp_.invert(base_.invert(wi));
    }

    /// Solid angle of the light, or with clipping of its part above the horizon [sr].
    NUSSELT_HD Real measure() const noexcept { return base_.measure(); }

private:
    template <class, int M, template <class> class, template <class, int> class>
    friend class PolygonWarpHart;

    /// The clamped cosine as a function of random numbers.
    struct CosineOf {
        const Base<Real, N>& base;

        NUSSELT_HD Real operator()(const Vec2<Real>& u) const noexcept {
            return max(base.sample(u).wi.z, Real(0));
        }
    };

    /// The density of the base may be as large as any number.
    NUSSELT_HD static Real finite(const Real& density) noexcept {
        return min(density, Real(std::numeric_limits<scalar_t<Real>>::max()));
    }

    Base<Real, N> base_;
    Warp<Real> warp_;
};

/// The bilinear warp on top of the solid angle of the whole polygon.
template <class Real, int N>
using PolygonBilinearWarpHart = PolygonWarpHart<Real, N, hart::BilinearWarp, PolygonSolidAngle>;
/// The bilinear warp on top of the solid angle above the horizon.
template <class Real, int N>
using PolygonClippedBilinearWarpHart = PolygonWarpHart<Real, N, hart::BilinearWarp, PolygonClippedSolidAngle>;
/// The biquadratic warp on top of the solid angle of the whole polygon.
template <class Real, int N>
using PolygonBiquadraticWarpHart = PolygonWarpHart<Real, N, hart::BiquadraticWarp, PolygonSolidAngle>;
/// The biquadratic warp on top of the solid angle above the horizon.
template <class Real, int N>
using PolygonClippedBiquadraticWarpHart =
    PolygonWarpHart<Real, N, hart::BiquadraticWarp, PolygonClippedSolidAngle>;

NUSSELT_NAMESPACE_END
