#pragma once
/// A published method, to compare with: spheres in proportion to the cosine at the surface, by cut disks.
///
/// C. Peters, C. Dachsbacher 2019, Sampling Projected Spherical Caps in Real Time, PACMCGIT 2(1), doi:10.1145/3320282, Algorithms 1
/// to 4 (with the erratum): a projected cap above the horizon is an ellipse; one that the horizon cuts is a cut ellipse and a
/// segment of the unit disk; if its centre is below the horizon, it is a segment of the unit disk that is scaled in height and
/// width, with a density that is nearly constant.
///
/// Deviations: the inverse of the area of a cut disk is the cycloid of our sweep instead of the fitted quintic polynomial with an
/// error of 4e-6. The scale across has a form without division by zero at the highest point.
/// Known failures: the two parts of a cut cap make stratified random numbers meet in a seam; differences of numbers of order one
/// lose the digits of small lights at the horizon; weights vary by up to a factor of about 1.2 for centres below the horizon.

#include <nusselt/core/light_sample.h>
#include <nusselt/related/projected_cap.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///              of one light (see the broadcasting constructor).
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: wi.z / measure(), except for spheres that the horizon cuts
/// and whose centre is below it.
/// Space: shading space; clips to the horizon by itself.
/// Edge cases: no radius, nothing above the horizon, the origin inside: pdf = 0, measure 0.
template <class Real>
class SphereProjectedSolidAnglePeters {
    using Scalar = scalar_t<Real>;

public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit SphereProjectedSolidAnglePeters(const Sphere<Real>& light) noexcept : cap_(light) {
        const auto cut = cap_.cut < Real(1);
        rises_ = cap_.axis.y > Real(0);
        segment_ = Part(cap_.cut);
        const Real half = select(rises_, cap_.half.x, Real(1));
        const Real ratio = select(cut, min(max((cap_.cut - cap_.middle) / half, Real(-1)), Real(1)), Real(1));
        ellipse_ = Part(-ratio);
        const Real of_ellipse = select(rises_, cap_.half.x * cap_.half.y * ellipse_.area, Real(0));
        const Real total = of_ellipse + segment_.area;

        // The centre is below the horizon: the segment is scaled so that it has the height of the cap.
        edge_ = sqrt(max((Real(1) - cap_.cut) * (Real(1) + cap_.cut), Real(0)));
        base_ = cap_.cosine * cap_.axis.y;
        extent_ = cap_.sine * cap_.axis.x;
        scale_ = detail::over_positive(base_ + extent_, edge_);

        const Real sunken = segment_.area * scale_ * scale_;
        measure_ = select(cap_.is_lit, select(rises_, total, sunken), Real(0));
        const Real inverse = Real(1) / select(measure_ > Real(0), measure_, Real(1));
        const auto fits = is_finite(inverse) & (measure_ > Real(0));
        measure_ = select(fits, measure_, Real(0));
        inverse_measure_ = select(fits, inverse, Real(0));
        share_ = select(rises_, detail::over_positive(of_ellipse, total), Real(0));
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit SphereProjectedSolidAnglePeters(
        const SphereProjectedSolidAnglePeters<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x leads from the near side to the far side, u.y across.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto in_ellipse = u.x < share_;
        const Real part = select(in_ellipse, share_, Real(1) - share_);
        const Real rest = select(in_ellipse, u.x, Real(1) - u.x) / select(part > Real(0), part, Real(1));
        const Real largest = select(in_ellipse, ellipse_.angle, segment_.angle);
        const Real fraction = select(in_ellipse, ellipse_.fraction, segment_.fraction);
        const auto turn = sincos_half_turn(inverse_cycloid(min(rest, Real(1)), largest, fraction));
        const Vec2<Real> disk{select(in_ellipse, -turn.cos, turn.cos),
                              turn.sin * multiply_add(Real(2), u.y, Real(-1))};
        const Vec2<Real> half = select(in_ellipse, cap_.half, Vec2<Real>{Real(1), Real(1)});
        const Vec2<Real> flat{multiply_add(half.x, disk.x, select(in_ellipse, cap_.middle, Real(0))),
                              half.y * disk.y};
        // A segment of a sunken cap is scaled in height and width, and x follows.
        const Real up = sqrt(max((Real(1) - disk.x) * (Real(1) + disk.x) - disk.y * disk.y, Real(0)));
        const Real height = scale_ * up, width = width_at(up) * disk.y;
        const Vec2<Real> sunken{sqrt(max(Real(1) - height * height - width * width, Real(0))), width};
        const Vec2<Real> p = select(rises_, flat, sunken);
        const Real z = select(rises_, sqrt(max(Real(1) - dot(p, p), Real(0))), height);
        const Vec3<Real> wi = select(measure_ > Real(0), normalize(cap_.direction(p, z)),
                                     Vec3<Real>{Real(0), Real(0), Real(1)});
        return {wi, pdf(wi), cap_.distance(wi) * wi};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Real z = max(wi.z, Real(0));
        const Unscaled at = unscaled(wi);
        const Real squeeze = at.disk.x * at.width;
        const Real change = detail::over_positive(cap_.projected(wi).x, squeeze);
        const Real density = z * inverse_measure_ * select(rises_, Real(1), change);
        return select(is_finite(density), density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec2<Real> p = cap_.projected(wi);
        const auto in_ellipse = rises_ & ((p.x < cap_.cut) | !(cap_.cut < Real(1)));
        const Vec2<Real> safe = select(in_ellipse, cap_.half, Vec2<Real>{Real(1), Real(1)});
        const Vec2<Real> normalised{(p.x - select(in_ellipse, cap_.middle, Real(0))) / safe.x, p.y / safe.y};
        const Vec2<Real> disk = select(rises_, normalised, unscaled(wi).disk);
        const Real x = min(max(select(in_ellipse, -disk.x, disk.x), Real(-1)), Real(1));
        const Part part(x);
        const Real of_part = select(in_ellipse, ellipse_.area, segment_.area);
        const Real rest = min(detail::over_positive(part.area, of_part), Real(1));
        const Real sine = sqrt(max((Real(1) - x) * (Real(1) + x), Real(0)));
        const Real across = detail::over_positive(disk.y, sine);
        return {below_one(select(in_ellipse, share_ * rest, Real(1) - (Real(1) - share_) * rest)),
                below_one(Real(0.5) * (Real(1) + across))};
    }

    /// Projected solid angle of the part above the horizon [sr]; an estimate for centres below the horizon.
    NUSSELT_HD Real measure() const noexcept { return measure_; }

private:
    /// The part of a unit disk beyond a chord.
    struct Part {
        Real angle, fraction, area;

        Part() = default;
        /// \param distance of the chord from the centre, in [-1, 1].
        NUSSELT_HD explicit Part(const Real& distance) noexcept {
            const Real sine = sqrt(max((Real(1) - distance) * (Real(1) + distance), Real(0)));
            angle = atan2_positive(sine, distance);
            // Beyond the centre nothing cancels; the whole disk has no sine to divide by.
            const auto wide = distance < Real(0);
            const Real cube = angle * angle * angle;
            const Real of_wide = Real(1.5) * (angle - sine * distance) / select(wide, cube, Real(1));
            fraction = select(wide, of_wide, cycloid_fraction(angle, sine, max(distance, Real(0))));
            area = Real(Scalar(2) / 3) * fraction * cube;
        }
        template <class Single>
        NUSSELT_HD explicit Part(const Single& single) noexcept {
            broadcast_members<Real>(*this, single);
        }
        template <class Self, class Visit>
        NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
            visit(self.angle, self.fraction, self.area);
        }
    };
    struct Unscaled {
        Vec2<Real> disk;
        Real width;
    };

    /// How much a sunken cap is wider than the segment, at a height of the segment.
    NUSSELT_HD Real width_at(const Real& up) const noexcept {
        const Real level = detail::over_positive(scale_ * up - base_, extent_);
        const Real below = extent_ * (edge_ + up);
        return cap_.sine * sqrt(max(detail::over_positive(scale_ * (Real(1) + level), below), Real(0)));
    }
    /// The point of the segment from which a direction of a sunken cap is made.
    NUSSELT_HD Unscaled unscaled(const Vec3<Real>& wi) const noexcept {
        const Real up = detail::over_positive(max(wi.z, Real(0)), scale_);
        const Real width = width_at(up);
        const Real y = cap_.projected(wi).y / select(width > Real(0), width, Real(1));
        return {{sqrt(max(Real(1) - up * up - y * y, Real(0))), y}, width};
    }

    ProjectedCap<Real> cap_;
    Part segment_, ellipse_;
    Real edge_, base_, extent_,
        scale_;  ///< of a sunken cap: half width at the horizon, centre, extent, scale in height
    Real share_; ///< of the ellipse
    Real measure_, inverse_measure_;
    mask_t<Real> rises_; ///< whether the centre is above the horizon

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.cap_, self.segment_, self.ellipse_, self.edge_, self.base_, self.extent_, self.scale_,
              self.share_, self.measure_, self.inverse_measure_, self.rises_);
    }
};

NUSSELT_NAMESPACE_END
