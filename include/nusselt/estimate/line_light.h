#pragma once
/// The light that a surface reflects from the visible parts of lines on a polygonal light.
///
/// N. Billen, P. Dutre 2016, Line Sampling for Direct Illumination, doi:10.1111/cgf.12948, Sec. 5.3, with what it lacks:
/// glossy surfaces by linearly transformed cosines (Heitz and Hill 2017, Linear-Light Shading with Linearly Transformed
/// Cosines), and without bias by one point per line (docs/techniques/line_samples.md).

#include <type_traits>

#include <nusselt/estimate/mis.h>
#include <nusselt/estimate/surface.h>
#include <nusselt/line_samples/phong.h>
#include <nusselt/line_samples/shading.h>
#include <nusselt/line_samples/visible_parts.h>
#include <nusselt/sampling/cosine_arc.h>

NUSSELT_NAMESPACE_BEGIN

/// How LineLight::analytic() integrates the specular component of a BRDF along lines: by the lobe that was fitted to it.
/// BRDFs whose specular component has a closed form along lines specialise this template.
template <class Real, class Brdf>
struct SpecularAlongLines {
    using Surface = GlossySurface<Real, Brdf>;

    /// Whether analytic() is exact for both components.
    static constexpr bool kIsExact = std::is_same_v<Brdf, Lambert<Real>>;

    /// The factor of integral().
    NUSSELT_HD static Vec3<Real> albedo(const Surface& surface) noexcept { return surface.specular_albedo; }

    /// The integral of the component over a part of a line [1/m], divided by albedo().
    /// \param cosine the line in shading space.
    /// \param lobe   the line in the cosine space of the fitted lobe.
    /// \param part   above the surface, with finite ends [m].
    NUSSELT_HD static Real integral(const Surface& /*surface*/, const LobeLine<Real>& /*cosine*/,
                                    const LobeLine<Real>& lobe, const Interval<Real>& part) noexcept {
        return lobe.integral(lobe.clipped(part));
    }
};

/// Phong lobes by phong_part().
template <class Real>
struct SpecularAlongLines<Real, LambertPhong<Real>> {
    using Surface = GlossySurface<Real, LambertPhong<Real>>;

    static constexpr bool kIsExact = true;

    NUSSELT_HD static Vec3<Real> albedo(const Surface& surface) noexcept {
        return surface.brdf.phong.albedo();
    }
    NUSSELT_HD static Real integral(const Surface& surface, const LobeLine<Real>& cosine,
                                    const LobeLine<Real>& /*lobe*/, const Interval<Real>& part) noexcept {
        const Phong<Real>& phong = surface.brdf.phong;
        return phong_part(cosine, part, phong.mirror(), phong.exponent());
    }
};

/// One light and surface point, for many lines of the light. The light shines to both sides.
///
/// Results are the reflected radiance for a radiance of 1 of the light, per metre of offset: divided by the density of the
/// offset of the line, they are an estimate by themselves [1].
///
/// \tparam Real float, double, long double or a pack: a line per lane.
/// \tparam Brdf see GlossySurface.
template <class Real, class Brdf = Frostbite<Real>>
class LineLight {
    using Surface = GlossySurface<Real, Brdf>;
    using AlongLines = SpecularAlongLines<Real, Brdf>;

public:
    /// \param plane   of the light, in shading space with wo in the xz half-plane [m].
    /// \param reach   LineFamily::reach() of the lines [m], or more.
    /// \param surface must outlive the object.
    NUSSELT_HD LineLight(const LinePlane<Real>& plane, const Real& reach, const Surface& surface) noexcept
        : LineLight(ScaledPlane<Real>(plane, reach), surface) {}

    /// The integrals of a Lambertian lobe and of the specular one above the horizon of the surface. They are exact for
    /// Lambert and for Phong lobes of exponent 0 or at least 1, and otherwise biased by the misfit of the fitted lobe.
    /// They are not negative, and those of disjoint parts add up to that of the whole up to rounding.
    /// \param offset of the line [m].
    /// \param parts  its visible parts.
    NUSSELT_HD BrdfComponents<Real> analytic(const Real& offset,
                                             const VisibleParts<Real>& parts) const noexcept {
        const Line line = line_at(offset);
        Real diffuse = Real(0);
        Real specular = Real(0);
        for (int k = 0; k < parts.count(); ++k) {
            if (!any(parts[k].begin < parts[k].end)) continue;
            const Interval<Real> above = line.cosine.clipped(finite(parts[k]));
            diffuse = diffuse + line.cosine.integral(above);
            if (any(is_glossy_))
                specular = specular + AlongLines::integral(surface_, line.cosine, line.lobe, above);
        }
        return {diffuse * diffuse_albedo_, specular * AlongLines::albedo(surface_)};
    }

    /// An unbiased estimate: the integrals of the cosine and of the fitted lobe, corrected by one point of the visible
    /// parts, where the BRDF is compared with both. No shadow ray is needed. Can be negative.
    /// \param offset of the line [m].
    /// \param parts  its visible parts.
    /// \param u      random in [0, 1), stratified together with the offsets of other lines.
    NUSSELT_HD BrdfComponents<Real> unbiased(const Real& offset, const VisibleParts<Real>& parts,
                                             const Real& u) const noexcept {
        if constexpr (AlongLines::kIsExact) {
            return analytic(offset, parts);
        } else {
            const auto uniform = [](const Real&) { return Vec3<Real>{Real(1), Real(1), Real(1)}; };
            return estimate<1>(offset, parts, u, uniform);
        }
    }

    /// The same for a light whose radiance varies. Several points of the visible parts, stratified along the line, tell how bright
    /// these are: their number divides the noise, and they need no shadow rays.
    /// \tparam kPoints  at least 1.
    /// \param radiance  over the mean of the light: function of the coordinate along the line [m], the result has three channels.
    template <int kPoints, class Radiance>
    NUSSELT_HD BrdfComponents<Real> textured(const Real& offset, const VisibleParts<Real>& parts,
                                             const Real& u, const Radiance& radiance) const noexcept {
        return estimate<kPoints>(offset, parts, u, radiance);
    }

    /// The peak of the fitted lobe; diffuse surfaces have none.
    /// \param offsets of the light [m].
    NUSSELT_HD LinePeak<Real> peak(const Interval<Real>& offsets) const noexcept {
        const LinePeak<Real> of_lobe = lobe_.peak(offsets);
        constexpr scalar_t<Real> kInfinity = std::numeric_limits<scalar_t<Real>>::infinity();
        return {of_lobe.offset, select(is_glossy_, of_lobe.width, Real(kInfinity))};
    }

private:
    struct Line {
        LobeLine<Real> cosine; ///< in shading space, for the diffuse component
        LobeLine<Real> lobe;
    };

    /// A part of a line and a lobe, out of many that become known one after the other, in proportion to their weights.
    struct Choice {
        NUSSELT_HD void offer(const Real& weight, const Interval<Real>& candidate,
                              const mask_t<Real>& candidate_is_lobe) noexcept {
            total = total + weight;
            const Real probability = weight / select(total > Real(0), total, Real(1));
            const auto taken = u < probability;
            const Real rest = Real(1) - probability;
            const Real numerator = select(taken, u, u - probability);
            const Real denominator = select(taken, probability, rest);
            u = below_one(numerator / select(denominator > Real(0), denominator, Real(1)));
            part = {select(taken, candidate.begin, part.begin), select(taken, candidate.end, part.end)};
            is_lobe = (taken & candidate_is_lobe) | (is_lobe & !taken);
        }

        Real total = Real(0); ///< of the weights
        Real u = Real(0);     ///< random in [0, 1), independent of the choice
        Interval<Real> part{Real(0), Real(0)};
        mask_t<Real> is_lobe = mask_t<Real>(false);
    };

    /// Integrals of the cosine and of the lobe, corrected by stratified points.
    template <int kPoints, class Radiance>
    NUSSELT_HD BrdfComponents<Real> estimate(const Real& offset, const VisibleParts<Real>& parts,
                                             const Real& u, const Radiance& radiance) const noexcept {
        using Scalar = scalar_t<Real>;
        const Line line = line_at(offset);
        Real diffuse = Real(0);
        Real specular = Real(0);
        Choice choices[kPoints];
        for (int i = 0; i < kPoints; ++i)
            choices[i].u = Real(Scalar(1) / kPoints) * (u + Real(static_cast<Scalar>(i)));
        const auto offer = [&](const Real& weight, const Interval<Real>& candidate, bool is_lobe) {
            for (Choice& choice : choices) choice.offer(weight, candidate, mask_t<Real>(is_lobe));
        };
        for (int k = 0; k < parts.count(); ++k) {
            if (!any(parts[k].begin < parts[k].end)) continue;
            const Interval<Real> above = line.cosine.clipped(finite(parts[k]));
            const Real by_cosine = line.cosine.integral(above);
            diffuse = diffuse + by_cosine;
            offer(cosine_weight_ * by_cosine, above, false);
            if (!any(is_glossy_)) continue;
            const Interval<Real> lit = line.lobe.clipped(above);
            const Real by_lobe = line.lobe.integral(lit);
            specular = specular + by_lobe;
            offer(lobe_weight_ * by_lobe, lit, true);
        }
        BrdfComponents<Real> result{diffuse * diffuse_albedo_, specular * surface_.specular_albedo};
        if (!any(choices[0].total > Real(0))) return result;
        for (const Choice& choice : choices) {
            const Real at = coordinate_of(line, choice);
            const Vec3<Real> wi = direction_to(line, at);
            const Real cosine = max(wi.z, Real(0));
            const Real cosine_density = Real(1 / kPi<Scalar>) * cosine;
            const Real lobe_density = select(is_glossy_, surface_.lobe.density(wi), Real(0));
            // The change from directions to points of the line is the same in the integrand and in the density.
            const Real density = fma(cosine_weight_, cosine_density, lobe_weight_ * lobe_density);
            const auto drawn = (choice.total > Real(0)) & (density > Real(0));
            const Real share = Real(Scalar(1) / kPoints) * choice.total;
            const Real factor = select(drawn, share / select(drawn, density, Real(1)), Real(0));
            const BrdfComponents<Real> brdf = surface_.brdf.eval_components(wi);
            const Vec3<Real> lit = cosine * radiance(at);
            result.diffuse =
                fma(factor, lit * brdf.diffuse - cosine_density * diffuse_albedo_, result.diffuse);
            result.specular =
                fma(factor, lit * brdf.specular - lobe_density * surface_.specular_albedo, result.specular);
        }
        return result;
    }

    NUSSELT_HD LineLight(const ScaledPlane<Real>& plane, const Surface& surface) noexcept
        : surface_(surface), cosine_(plane), lobe_(plane, surface.lobe), is_glossy_(surface.is_glossy()) {
        // Estimates of it are negative for eyes below the surface.
        diffuse_albedo_ = max(surface.diffuse_albedo, Vec3<Real>{Real(0), Real(0), Real(0)});
        lobe_weight_ = select(is_glossy_, largest_of(surface.specular_albedo), Real(0));
        // Lobes do not reach everywhere: without points by the cosine, what they miss of a metal would never be found. A
        // smaller share of them costs up to a third more noise (roughness 0.5), none by the lobe 7 times (roughness 0.1).
        const Real share = lobe_weight_ + largest_of(diffuse_albedo_);
        cosine_weight_ = max(share, Real(scalar_t<Real>(kSmallestDiffuseAlbedo)));
    }

    NUSSELT_HD static Real largest_of(const Vec3<Real>& v) noexcept { return max(max(v.x, v.y), v.z); }

    NUSSELT_HD Line line_at(const Real& offset) const noexcept {
        return {cosine_.line(offset), lobe_.line(offset)};
    }

    /// Empty parts get finite ends.
    NUSSELT_HD static Interval<Real> finite(const Interval<Real>& part) noexcept {
        const auto lit = part.begin < part.end;
        return {select(lit, part.begin, Real(0)), select(lit, part.end, Real(0))};
    }

    /// A point of the part, with a density by the lobe: its coordinate along the line [m].
    NUSSELT_HD Real coordinate_of(const Line& line, const Choice& choice) const noexcept {
        const auto image = LobeLine<Real>::select_between(choice.is_lobe, line.lobe, line.cosine);
        const CosineArc<Real> arc(image.extent(choice.part));
        const Real coordinate = dot(arc.map().position(arc.point(choice.u)), image.along) - image.shift;
        const Real at = coordinate / select(image.stretch > Real(0), image.stretch, Real(1));
        return min(max(at, choice.part.begin), choice.part.end);
    }
    NUSSELT_HD Vec3<Real> direction_to(const Line& line, const Real& at) const noexcept {
        const Vec3<Real> p =
            fma(fma(at, line.cosine.stretch, line.cosine.shift), line.cosine.along, line.cosine.closest);
        return inverse_length(p) * p;
    }

    const Surface& surface_;

    LobePlane<Real, BothSides> cosine_;
    LobePlane<Real, BothSides> lobe_;

    mask_t<Real> is_glossy_;
    Vec3<Real> diffuse_albedo_;
    Real cosine_weight_, lobe_weight_; ///< of the integrals, for the choice of a point
};

NUSSELT_NAMESPACE_END
