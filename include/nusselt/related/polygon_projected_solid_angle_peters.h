#pragma once
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as
/// printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672:
/// Sec. 3, with the sectors of azimuth_sectors.h. Use PolygonProjectedSolidAngle instead: this one loses small lights to
/// the difference of two arctangents, and its iteration diverges at some corners on the horizon.

#include <nusselt/related/azimuth_sectors.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double.
/// \tparam N    bound on the number of vertices before clipping, 3 to 8.
///
/// Measure and space as PolygonProjectedSolidAngle.
template <class Real, int N>
class PolygonProjectedSolidAnglePeters {
    using Mask = mask_t<Real>;
    using Sectors = AzimuthSectors<Real, N>;
    using Sector = typename Sectors::Sector;

public:
    /// \param light in shading space, either winding [m].
    NUSSELT_HD explicit PolygonProjectedSolidAnglePeters(const ConvexPolygon<Real, N>& light) noexcept
        : sectors_(light) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit PolygonProjectedSolidAnglePeters(
        const PolygonProjectedSolidAnglePeters<Single, N>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2.
    /// \returns the direction alone, as the paper does; sample() adds density and point.
    NUSSELT_HD Vec3<Real> direction(const Vec2<Real>& u) const noexcept {
        Real area = u.x * sectors_.measure();
        const auto& s = sectors_.select_sector(area);
        const Mask& central = sectors_.central();
        Vec2<Real> w{Real(0), Real(0)};
        if (any(central)) w = invert_central(s, area);
        if (!all(central)) w = select(central, w, invert_decentral(s, area));
        return sectors_.direction(s, w, u.y);
    }

    /// \param u in [0, 1)^2.
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
    /// Eq. 6 for the form with the matrix [[a, b], [b, c]].
    NUSSELT_HD static Vec2<Real> root(const Real& a, const Real& b, const Real& c) noexcept {
        const Real r = sqrt(max(b * b - a * c, Real(0)));
        return select(b >= Real(0), Vec2<Real>{b + r, -a}, Vec2<Real>{c, r - b});
    }

    /// Sec. 3.2.
    NUSSELT_HD static Vec2<Real> invert_central(const Sector& s, const Real& area) noexcept {
        const Real root = sqrt(Real(1) + dot(s.outer, s.outer));
        const Vec2<Real> c = peters::times(s.outer, s.s0);
        const SinCos<Real> angle = peters::sincos_half_turn(Real(2) * root * area);
        return (root * angle.cos) * s.s0 + angle.sin * Vec2<Real>{-c.y, c.x};
    }

    /// Sec. 3.4 and two steps of Sec. 3.3.
    NUSSELT_HD static Vec2<Real> invert_decentral(const Sector& s, const Real& area) noexcept {
        const Vec2<Real> s0 = (Real(1) / sqrt(dot(s.s0, s.s0))) * s.s0;
        const Vec2<Real> s1 = (Real(1) / sqrt(dot(s.s1, s.s1))) * s.s1;
        const Vec2<Real> sh = s0 + s1;
        const auto reach = [](const Vec2<Real>& u, const Vec2<Real>& w) {
            return Real(1) / sqrt(peters::form(u, w));
        };
        const Real i0 = reach(s.inner, s0), ih = reach(s.inner, sh), i1 = reach(s.inner, s1);
        const Real o0 = reach(s.outer, s0), oh = reach(s.outer, sh), o1 = reach(s.outer, s1);
        const Real fraction = min(area / s.area, Real(1));
        const Real quad_0 = o0 * oh - i0 * ih;
        const Real quad_1 = o1 * oh - i1 * ih;
        Real quad_area = fraction * (quad_0 + quad_1) - quad_0;
        const Mask first = quad_area <= Real(0);
        const Vec2<Real> sk = select(first, s0, s1);
        const Real ik = select(first, i0, i1);
        const Real ok = select(first, o0, o1);
        quad_area = select(first, quad_area + quad_0, quad_area - quad_1) * abs(peters::plain_det(sh, sk));
        const Vec2<Real> ri = peters::times(s.inner, ih * sh + ik * sk);
        const Vec2<Real> ro = peters::times(s.outer, oh * sh + ok * sk);
        const Vec2<Real> turned{-sk.y, sk.x};
        const Vec2<Real> p = (ok * oh * dot(ro, sh)) * turned;
        const Vec2<Real> q = (ik * ih * dot(ri, sh)) * turned + quad_area * ri;
        Vec2<Real> w = directed(root(p.x * ri.x - q.x * ro.x,
                                     Real(0.5) * (p.x * ri.y + p.y * ri.x - q.x * ro.y - q.y * ro.x),
                                     p.y * ri.y - q.y * ro.y),
                                sh);
        // At the ends of the sector, the initial value is better than the iteration.
        const Mask iterated = (fraction >= Real(1e-5)) & (fraction <= Real(1 - 1e-5));
        if (!any(iterated)) return w;
        NUSSELT_UNROLL
        for (int k = 0; k < 2; ++k) {
            const Real missing =
                Real(2) * (area - peters::area_of(s.outer, s0, w) + peters::area_of(s.inner, s0, w));
            const Vec2<Real> ci = peters::times(s.inner, w);
            const Vec2<Real> co = peters::times(s.outer, w);
            const Vec2<Real> gap = ci - co;
            const Vec2<Real> next =
                root(-w.y * gap.x - missing * ci.x * co.x,
                     Real(0.5) * (-w.y * gap.y + w.x * gap.x - missing * (ci.x * co.y + ci.y * co.x)),
                     w.x * gap.y - missing * ci.y * co.y);
            w = select(iterated, directed(next, sh), w);
        }
        return w;
    }

    /// w with the sign of a direction within the sector, normalised in the L1 norm.
    NUSSELT_HD static Vec2<Real> directed(const Vec2<Real>& w, const Vec2<Real>& sh) noexcept {
        const Real inverse = Real(1) / (abs(w.x) + abs(w.y));
        return select(dot(w, sh) < Real(0), -inverse, inverse) * w;
    }

    Sectors sectors_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.sectors_);
    }
};

NUSSELT_NAMESPACE_END
