#pragma once
/// A published method, to compare with: solid angle sampling of a linear light with a random number that is warped to follow
/// the cosine at the surface.
///
/// D. Hart, M. Pharr, T. Müller, W. Lopes, M. McGuire, P. Shirley 2020, Practical Product Sampling by Fitting and Composing
/// Warps, CGF 39(4), doi:10.1111/cgf.14060. For lines on top of solid angle sampling as C. Peters 2021, BRDF Importance
/// Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379, Sec. 5.1 compares it, with or without clipping. The density
/// is a linear or quadratic function of the random number, with the cosines, clamped to 0, of both ends and, if quadratic, of
/// the middle as control values.
///
/// Use LineProjectedSolidAngle instead: its density is the cosine. Known failures of this one:
/// - The linear warp gains nothing from long lights overhead, whose cosine is largest between the ends. It is worse than
///   its base where one end is on the horizon and the middle is higher than the other end.
/// - Without clipping, much of the density may lie below the horizon.
/// - pdf(wi) inverts the map to random numbers, which is inaccurate for lights that are seen as short as rounding errors.
///   There it deviates from the density of the sample.

#include <nusselt/related/hart_warps.h>
#include <nusselt/sampling/line_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per lane.
/// \tparam Warp hart::LinearWarp or hart::QuadraticWarp.
/// \tparam Base the technique below: LineSolidAngle or LineClippedSolidAngle.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr]: that of the base
/// times that of the warp. Space: shading space. With LineSolidAngle nothing is clipped, so that wi may point below the
/// horizon. Edge cases: no length, or origin on the infinite line up to rounding: pdf = 0, measure 0. All cosines 0: the
/// density of the base. u = 0 where the line begins on the horizon: pdf = 0.
template <class Real, template <class> class Warp, template <class> class Base>
class LineWarpHart {
public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit LineWarpHart(const LineSegment<Real>& light) noexcept
        : base_(light),
          // An end below the horizon counts as 0, and so does the point on the horizon that replaces it.
          warp_(Warp<Real>::fit(cosine_of(light.p0), cosine_of(light.p0 + light.length * light.s),
                                CosineOf{base_})) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit LineWarpHart(const LineWarpHart<Single, Warp, Base>& single) noexcept
        : base_(single.base_), warp_(single.warp_) {}

    /// \param u in [0, 1); increasing u moves from the start of the light to its end.
    NUSSELT_HD LightSample<Real> sample(const Real& u) const noexcept {
        const Real x = warp_.sample(u);
        LightSample<Real> s = base_.sample(x);
        s.pdf = finite(warp_.density(x) * s.pdf);
        return s;
    }

    /// \param wi a unit direction on the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        return finite(warp_.density(base_.invert(wi)) * base_.pdf(wi));
    }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept { return warp_.invert(base_.invert(wi)); }

    /// Solid angle per radius of the light, or with clipping of its part above the horizon [sr/m].
    NUSSELT_HD Real measure() const noexcept { return base_.measure(); }

private:
    template <class, template <class> class, template <class> class>
    friend class LineWarpHart;

    NUSSELT_HD static Real cosine_of(const Vec3<Real>& p) noexcept { return max(normalize(p).z, Real(0)); }

    /// The clamped cosine as a function of the random number.
    struct CosineOf {
        const Base<Real>& base;

        NUSSELT_HD Real operator()(const Real& u) const noexcept { return max(base.sample(u).wi.z, Real(0)); }
    };

    /// The density of the base may be as large as any number.
    NUSSELT_HD static Real finite(const Real& density) noexcept {
        return min(density, Real(std::numeric_limits<scalar_t<Real>>::max()));
    }

    Base<Real> base_;
    Warp<Real> warp_;
};

/// The linear warp on top of the solid angle of the whole line.
template <class Real>
using LineLinearWarpHart = LineWarpHart<Real, hart::LinearWarp, LineSolidAngle>;
/// The linear warp on top of the solid angle above the horizon.
template <class Real>
using LineClippedLinearWarpHart = LineWarpHart<Real, hart::LinearWarp, LineClippedSolidAngle>;
/// The quadratic warp on top of the solid angle of the whole line.
template <class Real>
using LineQuadraticWarpHart = LineWarpHart<Real, hart::QuadraticWarp, LineSolidAngle>;
/// The quadratic warp on top of the solid angle above the horizon.
template <class Real>
using LineClippedQuadraticWarpHart = LineWarpHart<Real, hart::QuadraticWarp, LineClippedSolidAngle>;

NUSSELT_NAMESPACE_END
