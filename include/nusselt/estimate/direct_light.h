#pragma once
/// The light that a surface with a diffuse and a specular component reflects from one light, estimated without bias from
/// a few samples.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, Sec. 4, doi:10.1145/3450626.3459672, and BRDF Importance
/// Sampling for Linear Lights, Sec. 4, doi:10.1111/cgf.14379.

#include <type_traits>
#include <utility>

#include <nusselt/estimate/mis.h>
#include <nusselt/estimate/strategies.h>

NUSSELT_NAMESPACE_BEGIN

/// A sample of direct light. With V = 1 if the way to the light is free, else 0, and the radiance L of the light [W/(sr
/// m^2)] (radiance times radius [W/(sr m)] for linear lights), it adds L (V shadowed + constant) to the reflected radiance.
template <class Real>
struct DirectLightSample {
    Vec3<Real> wi;       ///< unit direction to the light, in shading space
    Vec3<Real> p;        ///< the point on the light [m]
    Vec3<Real> shadowed; ///< zero where no shadow ray is needed
    Vec3<Real> constant; ///< zero except for OptimalHeuristic
};

/// What heuristics need to know about a sample.
/// \param pdf densities of the diffuse and the specular technique at the sample, counted where it was drawn.
template <class Real, class Brdf>
NUSSELT_HD inline MisSample<Real, 2> mis_sample(const GlossySurface<Real, Brdf>& surface,
                                                const LightSample<Real>& s, const Vec2<Real>& pdf) noexcept {
    // NaN, which no technique should return, counts as drawn, so that it is noticed.
    const auto drawn = s.pdf != Real(0);
    const auto above = drawn & (s.wi.z > Real(0));
    const BrdfComponents<Real> brdf = surface.brdf.eval_components(s.wi);
    const Real cosine = select(above, s.wi.z, Real(0));
    const Vec3<Real> zero{Real(0), Real(0), Real(0)};
    // Densities are those that samples really have, below the surface too: OptimalHeuristic counts on it.
    return {{select(drawn, pdf.x, Real(0)), select(drawn & surface.is_glossy(), pdf.y, Real(0))},
            {select(above, cosine * brdf.diffuse, zero), select(above, cosine * brdf.specular, zero)}};
}

/// A sample with the estimate of a heuristic.
template <class Real>
NUSSELT_HD inline DirectLightSample<Real> direct_light_sample(const LightSample<Real>& s,
                                                              const MisEstimate<Real>& estimate) noexcept {
    // At a line that almost meets the point this overflows, and infinity times no visibility is NaN.
    const auto limited = [](const Real& x) {
        const auto most = Real(std::numeric_limits<scalar_t<Real>>::max());
        return select(x > most, Real(0), x);
    };
    const Vec3<Real>& f = estimate.shadowed;
    return {s.wi, s.p, {limited(f.x), limited(f.y), limited(f.z)}, estimate.constant};
}

/// The diffuse albedo for coefficients of heuristics, see kSmallestDiffuseAlbedo.
template <class Real>
NUSSELT_HD inline Vec3<Real> albedo_for_mis(const Vec3<Real>& diffuse_albedo) noexcept {
    const auto least = Real(scalar_t<Real>(kSmallestDiffuseAlbedo));
    return max(diffuse_albedo, Vec3<Real>{least, least, least});
}

/// One light at one surface point: techniques for both components, whose samples any heuristic can combine.
///
/// Estimates are unbiased for all heuristics, unless a technique of the pair is biased itself: the technique for the
/// diffuse component covers all of the light above the surface and takes over where the lobe is zero; samples below the
/// surface count, with a BRDF of zero.
///
/// \tparam Real       float, double, long double or a pack: one light and surface point per lane.
/// \tparam Light      ConvexPolygon<Real, N>, LineSegment<Real>, Cylinder<Real>, Sphere<Real>, Disk<Real>, Ellipse<Real> or
///                    Ellipsoid<Real>.
/// \tparam Brdf       see GlossySurface.
/// \tparam Strategies see strategies.h.
template <class Real, class Light, class Brdf = Frostbite<Real>, class Strategies = ProjectedSolidAngleAndLtc>
class DirectLight {
    using Surface = GlossySurface<Real, Brdf>;

public:
    /// \param light            in shading space with wo in the xz half-plane [m].
    /// \param surface          must outlive the object.
    /// \param diffuse_samples  how often sample_diffuse() will be called, > 0.
    /// \param specular_samples how often sample_specular() will be called, > 0.
    NUSSELT_HD DirectLight(const Light& light, const Surface& surface, const Real& diffuse_samples = Real(1),
                           const Real& specular_samples = Real(1)) noexcept
        : surface_(surface),
          diffuse_(Strategies::diffuse(light, surface)),
          specular_(Strategies::specular(light, surface)) {
        is_glossy_ = surface.is_glossy();
        techniques_ = {{diffuse_samples, specular_samples},
                       {Strategies::diffuse_integral(diffuse_) * albedo_for_mis(surface.diffuse_albedo),
                        Strategies::specular_integral(specular_) * surface.specular_albedo}};
    }

    /// A sample of the technique for the diffuse component.
    /// \param u random in [0, 1)^2; linear lights use x only.
    template <class Heuristic>
    NUSSELT_HD DirectLightSample<Real> sample_diffuse(const Heuristic& heuristic,
                                                      const Vec2<Real>& u) const noexcept {
        const LightSample<Real> s = draw(diffuse_, u);
        return direct_light_sample(s, heuristic.template estimate<0>(techniques_, densities_at(s)));
    }

    /// A sample of the technique for the specular component; none where the surface is not glossy.
    /// \param u random in [0, 1)^2, independent of that for the diffuse component; linear lights use x only.
    template <class Heuristic>
    NUSSELT_HD DirectLightSample<Real> sample_specular(const Heuristic& heuristic,
                                                       const Vec2<Real>& u) const noexcept {
        const LightSample<Real> s = draw_specular(u);
        return direct_light_sample(s, heuristic.template estimate<1>(techniques_, densities_at(s)));
    }

    /// A sample of either technique, chosen at random: an estimate by itself.
    /// \param u random in [0, 1)^2; linear lights use x only.
    NUSSELT_HD DirectLightSample<Real> sample_one(const Vec2<Real>& u) const noexcept {
        const OneSampleChoice<Real, 2> choice(techniques_);
        const auto decision = choice.decide(u.x);
        const Vec2<Real> v{decision.u, u.y};
        LightSample<Real> s{{Real(0), Real(0), Real(1)}, Real(0), {Real(0), Real(0), Real(1)}};
        if (any(decision.chosen[0])) s = draw(diffuse_, v);
        if (any(decision.chosen[1])) {
            const LightSample<Real> other = draw_specular(v);
            s.wi = select(decision.chosen[1], other.wi, s.wi);
            s.p = select(decision.chosen[1], other.p, s.p);
            s.pdf = select(decision.chosen[1], other.pdf, s.pdf);
        }
        return direct_light_sample(s, choice.estimate(densities_at(s)));
    }

private:
    NUSSELT_HD LightSample<Real> draw_specular(const Vec2<Real>& u) const noexcept {
        LightSample<Real> s = draw(specular_, u);
        s.pdf = select(is_glossy_, s.pdf, Real(0));
        return s;
    }

    NUSSELT_HD MisSample<Real, 2> densities_at(const LightSample<Real>& s) const noexcept {
        return mis_sample(surface_, s, {diffuse_.pdf(s.wi), specular_.pdf(s.wi)});
    }

    const Surface& surface_;
    decltype(Strategies::diffuse(std::declval<const Light&>(), std::declval<const Surface&>())) diffuse_;
    decltype(Strategies::specular(std::declval<const Light&>(), std::declval<const Surface&>())) specular_;
    mask_t<Real> is_glossy_;
    MisTechniques<Real, 2> techniques_;
};

/// A point of a surface in world space, with the Frostbite BRDF.
template <class Real>
struct SurfacePoint {
    Vec3<Real> position; ///< [m]
    Vec3<Real> normal;   ///< unit
    Vec3<Real> wo;       ///< unit direction to the eye
    Vec3<Real> albedo;   ///< of the diffuse component, in [0, 1]
    Vec3<Real> f0;       ///< reflectance of the specular component at normal incidence, in [0, 1]
    Real roughness;      ///< perceptual, in [0, 1]
};

/// A sample of direct light in world space.
template <class Real>
struct WorldLightSample {
    Vec3<Real> direction; ///< unit, from the point of the surface to the light
    Real distance;        ///< to the light [m]
    Vec3<Real> shadowed;  ///< see DirectLightSample
    Vec3<Real> constant;  ///< see DirectLightSample
};

/// Two samples, one for each component.
template <class Real>
struct WorldLightSamples {
    WorldLightSample<Real> sample[2];
};

/// Everything in one call: an unbiased estimate of the light that a point of a surface reflects, from two samples. It is
/// the sum over both of radiance (visibility shadowed + constant).
/// \param light     ConvexPolygon, Cylinder, LineSegment or a round light in world space; the emission of lines is radiance times radius.
/// \param table     of the specular Frostbite BRDF.
/// \param heuristic such as ClampedOptimalHeuristic<Real>{0.5}.
/// \param u         two independent points of [0, 1)^2; linear lights use x only.
template <class Real, class Light, class Heuristic>
NUSSELT_HD inline WorldLightSamples<Real>
sample_direct_light(const SurfacePoint<Real>& point, const Light& light, const LtcTableView& table,
                    const Heuristic& heuristic, const Vec2<Real> (&u)[2]) noexcept {
    const Frame<Real> frame = shading_frame(point.normal, point.wo);
    const GlossySurface<Real> surface =
        make_glossy_surface(dot(point.normal, point.wo), point.albedo, point.f0, point.roughness, table);
    const auto local = to_shading_space(light, point.position, frame);
    const DirectLight<Real, std::remove_const_t<decltype(local)>> estimator(local, surface);
    const auto to_world = [&](const DirectLightSample<Real>& s) {
        return WorldLightSample<Real>{frame.to_world(s.wi), length(s.p), s.shadowed, s.constant};
    };
    return {{to_world(estimator.sample_diffuse(heuristic, u[0])),
             to_world(estimator.sample_specular(heuristic, u[1]))}};
}

NUSSELT_NAMESPACE_END
