#pragma once
/// A method to compare with: a thin rectangle in place of a linear light, as renderers use it that have rectangles
/// but no linear lights.
///
/// The rectangle has the line as its middle and faces the shading point, so that it is as wide as the outline of
/// the cylinder whose radius tends to zero and sends the same light to this point. Its solid angle is sampled by
/// the map of C. Ureña, M. Fajardo, A. King 2013, An Area-Preserving Parametrization for Spherical Rectangles, CGF
/// 32(4), doi:10.1111/cgf.12151, whose random number across the width stays at one half. Use LineSolidAngle
/// instead: it has the same samples and densities at a fraction of the cost. C. Peters 2021, BRDF Importance
/// Sampling for Linear Lights, CGF 40(8), doi:10.1111/cgf.14379, Table 1, compares both.
///
/// Bias: let R be half the width and d the distance of the line. The solid angle of the rectangle falls short of that
/// of the line by up to half of (R / d)^2 of itself. Here R is so small that this is less than rounding. With the
/// radius of a real tube in its place, the light would be up to half a percent too dark at a distance of ten radii.
/// Known failures: lights that point at the shading point lose digits, because their rectangle is seen edge-on.

#include <limits>

#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/clip_line.h>
#include <nusselt/related/rectangle_polygon.h>
#include <nusselt/sampling/rectangle_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or
///              many samples of one light (see the broadcasting constructor).
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr], the
/// constant 1 / measure(). The emission of the light is radiance times radius, so that the radius cancels.
/// Space: any frame with the shading point as origin; no normal is involved and nothing is clipped.
/// Edge cases: no length, or origin on the infinite line up to rounding: pdf = 0, measure 0.
template <class Real>
class LineRectangleUrena {
public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit LineRectangleUrena(const LineSegment<Real>& light) noexcept
        : LineRectangleUrena(to_safe_extent(light)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit LineRectangleUrena(const LineRectangleUrena<Single>& single) noexcept
        : rectangle_(single.rectangle_),
          inverse_scale_(single.inverse_scale_),
          measure_(single.measure_),
          density_(single.density_) {}

    /// \param u in [0, 1); increasing u moves from the start of the light to its end.
    NUSSELT_HD LightSample<Real> sample(const Real& u) const noexcept {
        const LightSample<Real> s = rectangle_.sample({u, Real(0.5)});
        return {s.wi, density_, inverse_scale_ * s.p};
    }

    /// Constant on the light; the caller knows that wi hits it.
    NUSSELT_HD Real pdf(const Vec3<Real>&) const noexcept { return density_; }

    /// The random number for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Real invert(const Vec3<Real>& wi) const noexcept { return rectangle_.invert(wi).x; }

    /// Solid angle per radius [sr/m].
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    /// Half the width over the distance of the line. Its square is a rounding error.
    static constexpr scalar_t<Real> kThinness =
        power_of_two<scalar_t<Real>>(-std::numeric_limits<scalar_t<Real>>::digits / 2);

    NUSSELT_HD explicit LineRectangleUrena(const SafeLine<Real>& safe) noexcept
        : LineRectangleUrena(safe, centered(safe)) {}

    NUSSELT_HD LineRectangleUrena(const SafeLine<Real>& safe, const CenteredLine<Real>& line) noexcept
        : rectangle_(rectangle_around(safe.line, line)), inverse_scale_(safe.inverse_scale) {
        const Real radius = Real(kThinness) * sqrt(line.squared);
        const Real measure = rectangle_.measure() / radius * safe.scale;
        const Real density = rectangle_.pdf(line.inward) * radius * inverse_scale_;
        const auto lit = has_reciprocal(measure);
        measure_ = select(lit, measure, Real(0));
        density_ = select(lit, density, Real(0));
    }

    NUSSELT_HD static ConvexPolygon<Real, 4> rectangle_around(const LineSegment<Real>& light,
                                                              const CenteredLine<Real>& line) noexcept {
        const Real inverse_distance = Real(1) / sqrt(line.squared);
        const Vec3<Real> half = Real(kThinness) * cross(line.closest, light.s);
        return rectangle_polygon(light.p0 - half, line.length * light.s, Real(2) * half,
                                 inverse_distance * line.closest);
    }

    RectangleSolidAngle<Real> rectangle_; ///< in units in which products of coordinates stay in range
    Real inverse_scale_;
    Real measure_, density_;

    template <class>
    friend class LineRectangleUrena;
};

NUSSELT_NAMESPACE_END
