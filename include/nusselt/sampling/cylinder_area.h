#pragma once
/// Uniform sampling of the surface of a closed cylinder, caps included. Cheap to prepare, but half of the samples or
/// more lie on the far side, and it is noisy close to the light.

#include <nusselt/core/broadcast.h>
#include <nusselt/core/light_sample.h>
#include <nusselt/geometry/cylinder.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real float, double, long double or a pack of float or double, one light and shading point per lane.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]: |p|^2 / (area cos_light).
/// Space: any frame with the shading point as origin; no clipping, so that wi may point below the horizon.
/// Edge cases: points that face away from the origin, no length or radius: pdf = 0.
template <class Real>
class CylinderArea {
public:
    /// \param light relative to the shading point [m].
    NUSSELT_HD explicit CylinderArea(const Cylinder<Real>& light) noexcept
        : light_(light), frame_(Frame<Real>::from_normal(light.axis.s)) {}

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit CylinderArea(const CylinderArea<Single>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, increasing u.y moves from the middle of the cap at the start over
    ///          the lateral surface to the middle of the other cap.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real& radius = light_.radius;
        const Real& length = light_.axis.length;
        // Choose the position along the profile. In units of the circumference, a cap counts half its radius.
        const Real half = Real(scalar_t<Real>(0.5)) * radius;
        const Real position = u.y * (length + radius);
        const auto on_first = position < half;
        const auto on_side = (!on_first) & (position < half + length);
        const Real to_middle = max(select(on_first, position, length + radius - position), Real(0));
        const Real on_cap = radius * sqrt(min(to_middle / select(half > Real(0), half, Real(1)), Real(1)));
        const Real rho = select(on_side, radius, on_cap);
        const Real along = select(on_first, Real(0), min(position - half, length));

        // Choose the azimuth, in [-pi, pi).
        const Real turn = Real(kPi<scalar_t<Real>>) * fma(Real(2), u.x, Real(-1));
        const SinCos<Real> half_turn = sincos_half_turn(abs(turn));
        const Vec3<Real> outwards = half_turn.cos * frame_.t + copysign(half_turn.sin, turn) * frame_.b;

        // Put both together.
        const Vec3<Real> p = fma(rho, outwards, fma(along, light_.axis.s, light_.axis.p0));
        const Vec3<Real> on_caps = select(on_first, -light_.axis.s, light_.axis.s);
        const Vec3<Real> normal = select(on_side, outwards, on_caps);
        const Vec3<Real> wi = inverse_length(p) * p;
        return {wi, density(nusselt::length(p), -dot(wi, normal)), p};
    }

    /// \param wi a unit direction towards the light.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const LightHit<Real> hit = intersect(light_, wi);
        return select(hit.hits, density(hit.distance, hit.cosine), Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Real& radius = light_.radius;
        const Real& length = light_.axis.length;
        const Real distance = intersect(light_, wi).distance;

        // Find the point on the light in cylindrical coordinates.
        const Vec3<Real> from_start = distance * wi - light_.axis.p0;
        const Real along = dot(from_start, light_.axis.s);
        const Real x = dot(from_start, frame_.t);
        const Real y = dot(from_start, frame_.b);
        const Real turn = copysign(atan2_positive(abs(y), x), y);

        // Find its position along the profile. At the rims, where rounding decides, both parts of the profile meet.
        const Real rounding = Real(8 * std::numeric_limits<scalar_t<Real>>::epsilon()) * (distance + length);
        const Real half = Real(scalar_t<Real>(0.5)) * radius;
        const Real safe_radius = select(radius > Real(0), radius, Real(1));
        const Real share = min((x * x + y * y) / (safe_radius * safe_radius), Real(1));
        const auto on_first = along <= rounding;
        const auto on_second = along >= length - rounding;
        const Real on_cap = select(on_first, half * share, length + radius - half * share);
        const Real position = select(on_first | on_second, on_cap, half + along);
        const Real profile = length + radius;
        return {
            below_one(fma(turn, Real(scalar_t<Real>(0.5) / kPi<scalar_t<Real>>), Real(scalar_t<Real>(0.5)))),
            below_one(position / select(profile > Real(0), profile, Real(1)))};
    }

    /// Area of the lateral surface and the caps [m^2], no more than the largest number.
    NUSSELT_HD Real measure() const noexcept {
        const Real area =
            Real(2 * kPi<scalar_t<Real>>) * light_.radius * (light_.axis.length + light_.radius);
        return min(area, Real(std::numeric_limits<scalar_t<Real>>::max()));
    }

private:
    NUSSELT_HD Real density(const Real& distance, const Real& cosine) const noexcept {
        return detail::area_density(distance, measure() * cosine);
    }

    Cylinder<Real> light_;
    Frame<Real> frame_; ///< n is the direction of the axis

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.light_, self.frame_);
    }
};

NUSSELT_NAMESPACE_END
