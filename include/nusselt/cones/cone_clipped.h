#pragma once
/// Sampling of the part above the surface of spheres, disks, ellipses and ellipsoids, by solid angle and by linearly transformed
/// cosines. Preparing them is costly where the surface's horizon cuts the light; elsewhere samples are those of ConeSolidAngle
/// and ConeLtc.

#include <nusselt/cones/cone_ltc.h>
#include <nusselt/cones/cone_solid_angle.h>
#include <nusselt/cones/turns_above_plane.h>
#include <nusselt/cones/whole_cone.h>

NUSSELT_NAMESPACE_BEGIN

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///               of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. 1 / pdf is unbiased for the part above the horizon, and for
/// most lights within a few percent of the mean. Where the axis of the cone is next to the horizon, few samples have large weights, and
/// measure() is off by up to a tenth.
/// Space: shading space. wi.z is not negative.
/// Edge cases: those of ConeSolidAngle; nothing above the horizon: pdf = 0, measure 0.
template <class Real, template <class> class Light>
class ConeClippedSolidAngle {
public:
    /// \param light in shading space [m].
    NUSSELT_HD explicit ConeClippedSolidAngle(const Light<Real>& light) noexcept : whole_(light) {
        const auto cone = view_of(light, detail::SameSpace()).cone;
        turns_ = TurnsAbovePlane<Real>(whole_, cone, {Real(0), Real(0), Real(1)});
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeClippedSolidAngle(const ConeClippedSolidAngle<Single, Light>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2; u.x turns around the axis, u.y leads away from it.
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto turn = turns_.sample(whole_, u.x);
        LightSample<Real> s =
            whole_.sample({turn.x, below_one(multiply_add(u.y, turn.length(), turn.begin))});
        s.wi.z = max(s.wi.z, Real(0));
        s.pdf = s.pdf * detail::over_positive(turn.density, turn.length());
        s.pdf = select(is_finite(s.pdf), s.pdf, Real(0));
        return s;
    }

    /// \param wi a unit direction towards the light, above the horizon.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const auto turn = turns_.at(whole_, whole_.invert(wi).x);
        const Real density = whole_.pdf(wi) * detail::over_positive(turn.density, turn.length());
        return select(is_finite(density), density, Real(0));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light and above the horizon.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec2<Real> u = whole_.invert(wi);
        const auto turn = turns_.at(whole_, u.x);
        return {turns_.invert(u.x), below_one(detail::over_positive(u.y - turn.begin, turn.length()))};
    }

    /// Estimate of the solid angle above the horizon [sr].
    NUSSELT_HD Real measure() const noexcept { return turns_.share() * whole_.measure(); }

private:
    ConeSolidAngle<Real, Light> whole_;
    TurnsAbovePlane<Real> turns_;

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.whole_, self.turns_);
    }
};

/// \tparam Real  float, double, long double or a pack of float or double: one light and shading point per lane, or many samples
///               of one light (see the broadcasting constructor).
/// \tparam Light Sphere, Disk, Ellipse or Ellipsoid.
/// \tparam Steps of the iteration for images above the horizon of cosine space.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr]. density(wi) / pdf is unbiased for the part above both
/// horizons.
/// Space: shading space with wo in the xz half-plane (shading_frame()); clips to both horizons. wi.z is not negative.
/// Edge cases: those of ConeLtc; nothing above both horizons: pdf = 0, measure 0.
template <class Real, template <class> class Light, int Steps = kConeSteps<Real>>
class ConeClippedLtc {
    using Scalar = scalar_t<Real>;

public:
    /// \param light in shading space [m].
    NUSSELT_HD ConeClippedLtc(const Light<Real>& light, const Ltc<Real>& ltc) noexcept
        : ltc_(ltc),
          view_(view_of(light, [&](const Vec3<Real>& v) { return ltc.to_cosine(v); })),
          image_(view_.cone),
          turns_(image_, view_.cone, normalize(ltc.normal_to_cosine(Vec3<Real>{Real(0), Real(0), Real(1)}))) {
    }

    /// Broadcasts a technique for a single light to all lanes of a pack, to take many samples of one light.
    template <class Single>
    NUSSELT_HD explicit ConeClippedLtc(const ConeClippedLtc<Single, Light, Steps>& single) noexcept {
        broadcast_members<Real>(*this, single);
    }

    /// \param u in [0, 1)^2
    NUSSELT_HD LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const auto turn = turns_.sample(image_, u.x);
        const ConeSample<Real> s =
            image_.sample({turn.x, below_one(multiply_add(u.y, turn.length(), turn.begin))});
        const auto dark = !(measure() > Real(0));
        Vec3<Real> wi = select(dark, Vec3<Real>{Real(0), Real(0), Real(1)}, normalize(ltc_.to_shading(s.wi)));
        wi.z = max(wi.z, Real(0));
        const Real distance = max(dot(wi, view_.point(s.disk, wi)), Real(0));
        return {wi, density(wi, s.wi, turn), (view_.inverse_scale * distance) * wi};
    }

    /// \param wi a unit direction towards the light, above the horizon.
    NUSSELT_HD Real pdf(const Vec3<Real>& wi) const noexcept {
        const Vec3<Real> image = normalize(ltc_.to_cosine(wi));
        return density(wi, image, turns_.at(image_, image_.invert(image).x));
    }

    /// The random numbers for which sample() returns wi, a unit direction on the light and above the horizon.
    NUSSELT_HD Vec2<Real> invert(const Vec3<Real>& wi) const noexcept {
        const Vec2<Real> u = image_.invert(normalize(ltc_.to_cosine(wi)));
        const auto turn = turns_.at(image_, u.x);
        return {turns_.invert(u.x), below_one(detail::over_positive(u.y - turn.begin, turn.length()))};
    }

    /// Estimate of the integral of the lobe over the part of the light above the surface, in [0, 1].
    NUSSELT_HD Real measure() const noexcept {
        return min(Real(1 / kPi<Scalar>) * turns_.share() * image_.measure(), Real(1));
    }

private:
    template <class Turn>
    NUSSELT_HD Real density(const Vec3<Real>& wi, const Vec3<Real>& image, const Turn& turn) const noexcept {
        const Real factor =
            image_.density_per_cosine(image) * detail::over_positive(turn.density, turn.length());
        const Real density = Real(kPi<Scalar>) * ltc_.density(wi) * factor;
        return select(is_finite(density), density, Real(0));
    }

    Ltc<Real> ltc_;
    LightView<Light<Real>> view_; ///< its cone is in cosine space
    CosineCone<Real, Steps, kConePlaces> image_;
    TurnsAbovePlane<Real> turns_; ///< above the surface's horizon, in cosine space

    friend struct detail::Members;
    template <class Self, class Visit>
    NUSSELT_HD static void members(Self& self, const Visit& visit) noexcept {
        visit(self.ltc_, self.view_, self.image_, self.turns_);
    }
};

NUSSELT_NAMESPACE_END
