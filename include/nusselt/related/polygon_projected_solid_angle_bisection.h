#pragma once
/// A published method, to compare with: projected solid angle sampling by azimuth and inclination, inverted by bisection.
///
/// J. Arvo 2001, Stratified Sampling of 2-Manifolds, SIGGRAPH course State of the Art in Monte Carlo Ray Tracing for
/// Realistic Image Synthesis, with six bisections instead of his inversion, as D. Hart, M. Pharr, T. Müller, W. Lopes,
/// M. McGuire, P. Shirley 2020, Practical Product Sampling by Fitting and Composing Warps, CGF 39(4),
/// doi:10.1111/cgf.14060, found to be faster and more stable; compared by C. Peters 2021, BRDF Importance Sampling for
/// Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672, Sec. 3.8. The sectors are those of Peters. Halving angles
/// takes sums of unit vectors, no trigonometric functions. Use PolygonProjectedSolidAngle instead.
///
/// Known failures, which the tests show:
/// - Samples lie on 2^Steps azimuths of each sector: with six steps, they are off by up to a percent of their random number,
///   and small features of the light or of its shadow are missed however many samples there are.
/// - Small lights lose digits to the difference of two arctangents: in float, lights of a thousandth of their distance have
///   measures with errors of 2e-4.
/// - Coordinates must be of order one, and the plane of the light must not contain the shading point.

#include <nusselt/related/azimuth_sectors.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam N     bound on the number of vertices before clipping, 3 to 8.
/// \tparam Steps of bisection.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], wi.z / measure().
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon: pdf = 0, measure 0.
template <class Real, int N, int Steps = 6>
class PolygonProjectedSolidAngleBisection {
    using Mask = mask_t<Real>;
    using Sectors = AzimuthSectors<Real, N>;
    using Sector = typename Sectors::Sector;

public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit PolygonProjectedSolidAngleBisection(const ConvexPolygon<Real, N>& light) noexcept
        : sectors_(light) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonProjectedSolidAngleBisection(
        const PolygonProjectedSolidAngleBisection<Single, N, Steps>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; x selects the azimuth, y the inclination.
    /// \returns the direction alone; sample() adds density and point.
    NUSSELT_HD Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        Real area = u.x * sectors_.measure();
        const auto& s = sectors_.select_sector(area);
        return sectors_.direction(s, invert_area(s, area), u.y);
    }

    /// \copydoc direction
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        return sectors_.complete(direction(u));
    }

    /// \copydoc AzimuthSectors::pdf
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept { return sectors_.pdf(wi); }
    /// \copydoc AzimuthSectors::invert
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept { return sectors_.invert(wi); }
    /// \copydoc AzimuthSectors::measure
    NUSSELT_HD Real measure() const noexcept { return sectors_.measure(); }

private:
    NUSSELT_INLINE static Vec2<Real> unit(const Vec2<Real>& w) noexcept {
        return (Real(1) / sqrt(dot(w, w))) * w;
    }

    /// The middle of the interval of azimuths that is left after all steps.
    NUSSELT_HD Vec2<Real> invert_area(const Sector& s, const Real& area) const noexcept {
        Vec2<Real> low = unit(s.s0);
        Vec2<Real> high = unit(s.s1);
        // The sum of almost opposite vectors would not be accurate.
        const Vec2<Real> across = high - low;
        const Mask wide = dot(low, high) < Real(0);
        Vec2<Real> middle = unit(select(wide, Vec2<Real>{across.y, -across.x}, low + high));
        for (int k = 0; k < Steps; ++k) {
            const Mask beyond = s.area_to(middle, sectors_.central()) <= area;
            low = select(beyond, middle, low);
            high = select(beyond, high, middle);
            middle = unit(low + high);
        }
        return middle;
    }

    Sectors sectors_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.sectors_);
    }
};

NUSSELT_NAMESPACE_END
