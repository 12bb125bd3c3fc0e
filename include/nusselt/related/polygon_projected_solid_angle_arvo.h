#pragma once
/// A published method, to compare with: projected solid angle sampling by azimuth and inclination, inverted by Newton's
/// method.
///
/// J. Arvo 2001, Stratified Sampling of 2-Manifolds, SIGGRAPH course State of the Art in Monte Carlo Ray Tracing for
/// Realistic Image Synthesis; discussed by C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4),
/// doi:10.1145/3450626.3459672, Sec. 3.8. The area up to an azimuth is a sum of Lambert's terms of parts of edges. A cubic
/// polynomial through four azimuths at equal distances in a sector inverts it roughly, three steps of Newton's method
/// refine that, whether the zenith is in the light or not. The inclination has a closed form. As Peters does for his
/// comparison, we find the sectors by his algorithm. Deviation: steps that leave the sector go half of the way to its end.
/// Without that, one sample in a hundred of the triangles of the test would be off by more than 0.6 of its random
/// number. Use PolygonProjectedSolidAngle instead.
///
/// Known failures, which the tests show:
/// - Where the density vanishes at an end of a sector, as at most corners, the polynomial is far from the inverse, and
///   three steps do not always suffice: among random large triangles, one sample in a hundred is off by more than 0.02 of
///   its random number, one in a thousand by more than 0.1, the worst one by 0.7.
/// - Small lights lose digits to the difference of two arctangents: in float, lights of a thousandth of their distance have
///   measures with errors of 2e-4.
/// - Coordinates must be of order one, and the plane of the light must not contain the shading point.

#include <nusselt/related/azimuth_sectors.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many
///               samples of one light (see the broadcasting constructor).
/// \tparam N     bound on the number of vertices before clipping, 3 to 8.
/// \tparam Steps of Newton's method.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], wi.z / measure().
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon: pdf = 0, measure 0.
template <class Real, int N, int Steps = 3>
class PolygonProjectedSolidAngleArvo {
    using Mask = mask_t<Real>;
    using Sectors = AzimuthSectors<Real, N>;
    using Sector = typename Sectors::Sector;
    static constexpr int kSlots = Sectors::kSlots;

public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit PolygonProjectedSolidAngleArvo(const ConvexPolygon<Real, N>& light) noexcept
        : sectors_(light) {
        NUSSELT_UNROLL
        for (int k = 0; k < kSlots; ++k) {
            sweep_[k] = Real(0);
            cubic_[k] = {Real(0), Real(0), Real(0)};
            if (k < sectors_.count()) prepare_start(k);
        }
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonProjectedSolidAngleArvo(
        const PolygonProjectedSolidAngleArvo<Single, N, Steps>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; x selects the azimuth, y the inclination.
    /// \returns the direction alone; sample() adds density and point.
    NUSSELT_HD Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        Real area = u.x * sectors_.measure();
        Vec3<Real> cubic = cubic_[0];
        Real sweep = sweep_[0];
        const auto& s = sectors_.select_sector(area, [&](int k, const Mask& reached) {
            cubic = select(reached, cubic_[k], cubic);
            sweep = select(reached, sweep_[k], sweep);
        });
        return sectors_.direction(s, invert_area(s, cubic, sweep, area), u.y);
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
    /// The direction at an angle from the unit vector `begin`.
    NUSSELT_INLINE static Vec2<Real> turned(const Vec2<Real>& begin, const SinCos<Real>& angle) noexcept {
        return angle.cos * begin + angle.sin * Vec2<Real>{-begin.y, begin.x};
    }
    NUSSELT_INLINE static Vec2<Real> unit(const Vec2<Real>& w) noexcept {
        return (Real(1) / sqrt(dot(w, w))) * w;
    }

    /// Lagrange's polynomial through the shares of the area at four azimuths.
    NUSSELT_HD void prepare_start(int k) noexcept {
        const Sector& s = sectors_.sector(k);
        const Mask& central = sectors_.central();
        const Real sweep = peters::atan2_positive(peters::det(s.s0, s.s1), dot(s.s0, s.s1));
        const Real third = Real(1) / Real(3) * sweep;
        const SinCos<Real> turn = peters::sincos_half_turn(third);
        const Vec2<Real> w1 = turned(unit(s.s0), turn);
        const Real x1 = s.area_to(w1, central) / s.area;
        const Real x2 = s.area_to(turned(w1, turn), central) / s.area;

        // Newton's divided differences; the first node is the origin.
        const Real slope_01 = third / x1;
        const Real slope_12 = third / (x2 - x1);
        const Real slope_23 = third / (Real(1) - x2);
        const Real bend_02 = (slope_12 - slope_01) / x2;
        const Real bend_13 = (slope_23 - slope_12) / (Real(1) - x1);
        const Real cubic = bend_13 - bend_02;
        const Vec3<Real> polynomial{slope_01 - x1 * (bend_02 - x2 * cubic), bend_02 - (x1 + x2) * cubic,
                                    cubic};
        // Without order among rounded areas, the area counts as uniform.
        const Mask ordered = (x1 > Real(0)) & (x2 > x1) & (x2 < Real(1));
        cubic_[k] = select(ordered, polynomial, Vec3<Real>{sweep, Real(0), Real(0)});
        sweep_[k] = sweep;
    }

    /// The azimuth up to which a sector has an area.
    NUSSELT_HD Vec2<Real> invert_area(const Sector& s, const Vec3<Real>& cubic, const Real& sweep,
                                      const Real& area) const noexcept {
        const Mask& central = sectors_.central();
        const Vec2<Real> begin = unit(s.s0);
        const Real share = area / s.area;
        // Where the polynomial leaves the sector, the angle starts in proportion to the area.
        const Real polynomial = share * (cubic.x + share * (cubic.y + share * cubic.z));
        const Mask inside = (polynomial > Real(0)) & (polynomial < sweep);
        Real angle = select(inside, polynomial, share * sweep);
        Vec2<Real> w = turned(begin, peters::sincos_half_turn(angle));
        NUSSELT_UNROLL
        for (int k = 0; k < Steps; ++k) {
            // The derivative of the area is half of the difference between squared radii.
            Real density = Real(1) / peters::form(s.outer, w);
            if (!all(central))
                density = select(central, density, density - Real(1) / peters::form(s.inner, w));
            const Real excess = s.area_to(w, central) - area;
            const Mask rises = density > Real(0);
            const Real next = angle - Real(2) * excess / select(rises, density, Real(1));
            // A step that leaves the sector goes half of the way to its end: at the end itself, the density may vanish.
            const Real end = select(excess > Real(0), Real(0), sweep);
            const Mask stuck = (excess != Real(0)) & !rises;
            const Mask leaves = (next < Real(0)) | (next > sweep) | stuck;
            angle = select(leaves, Real(0.5) * (angle + end), next);
            w = turned(begin, peters::sincos_half_turn(angle));
        }
        return w;
    }

    Sectors sectors_;
    Vec3<Real>
        cubic_[kSlots];  ///< coefficients of powers 1 to 3, from shares of the area of a sector to angles
    Real sweep_[kSlots]; ///< the angles of sectors

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.sectors_, self.cubic_, self.sweep_);
    }
};

NUSSELT_NAMESPACE_END
