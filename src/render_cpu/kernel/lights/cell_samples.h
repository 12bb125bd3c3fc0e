#pragma once
/// Samples in proportion to radiance times a measure, for lights whose radiance varies.
///
/// They come from cells for each shading point. Where cells are the lanes, shading points take turns; all that follows a
/// sample has shading points as lanes again. A light is described by a type `Cells` with
///
///     LaneTechniques<...> diffuse(lanes), specular(lanes, lobe): techniques such as WindowedPolygon;
///     Vec3<float> radiance(sample, lane): what the light emits along a sample [W/(sr m^2)];
///     Vec3<float> point(sample): where its shadow ray ends, in shading space [m];
///     float density(technique, sample): of one of these techniques at a sample of the other one.
///
/// Techniques that have packs of shading points, such as TexturedPolygon and TexturedLine, are PackTechnique instead: then
/// the other functions take and return packs, and `radiance` the sample only.

#include "render_cpu/kernel/paired_techniques.h"
#include "render_cpu/kernel/single_lane.h"

#include <nusselt/core/light_sample.h>

#include <new>
#include <type_traits>
#include <utility>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Whether samples of lights with an extent come from cells.
inline bool takes_products(const render_cpu::RenderJob& job) noexcept {
    return job.emission_sampling == render::EmissionSampling::product &&
           (job.technique == render::Technique::projected_solid_angle ||
            job.technique == render::Technique::projected_solid_angle_biased);
}

/// The same for windows of tables by direction. The optimal heuristic needs densities whose integral is one. Where horizon or
/// outline cut a texel, it is less.
inline bool takes_windowed_products(const render_cpu::RenderJob& job) noexcept {
    const bool needs_whole_densities =
        job.strategies == render::Strategies::diffuse_ltc && job.mis == render::Mis::optimal;
    return takes_products(job) && !needs_whole_densities;
}

/// A technique for each shading point of a packet.
template <class Technique>
class LaneTechniques {
    static_assert(std::is_trivially_destructible<Technique>::value, "destructors are not called");

public:
    /// \param make    makes the technique of a lane
    /// \param present lanes that have one
    template <class Make>
    LaneTechniques(LaneMask present, const Make& make) noexcept : present_(present.bits()) {
        for (int lane = 0; lane < kLanes; ++lane)
            if (has(lane))
                ::new (static_cast<void*>(bytes_ + lane * sizeof(Technique))) Technique(make(lane));
    }

    // Copies of the bytes would not be techniques.
    LaneTechniques(const LaneTechniques&) = delete;
    LaneTechniques& operator=(const LaneTechniques&) = delete;

    bool has(int lane) const noexcept { return (present_ >> lane & 1u) != 0; }
    const Technique& operator[](int lane) const noexcept {
        return *std::launder(reinterpret_cast<const Technique*>(bytes_ + lane * sizeof(Technique)));
    }

    /// TexturedPolygon::unshadowed() of all lanes.
    Vector unshadowed() const noexcept {
        Lanes result{};
        for (int lane = 0; lane < kLanes; ++lane) {
            if (!has(lane)) continue;
            const Vec3<float> value = (*this)[lane].unshadowed();
            result.x[lane] = value.x;
            result.y[lane] = value.y;
            result.z[lane] = value.z;
        }
        return load(result);
    }

private:
    alignas(Technique) unsigned char bytes_[kLanes * sizeof(Technique)];
    std::uint32_t present_;
};

/// A technique for all shading points of a packet.
template <class Technique>
struct PackTechnique {
    LaneMask present; ///< lanes that have it
    Technique technique;

    /// TexturedPolygon::unshadowed() of all lanes.
    Vector unshadowed() const noexcept {
        return select(present, technique.unshadowed(), Vector{Real(0), Real(0), Real(0)});
    }
};

/// A sample for each shading point of a packet, from one technique of a pair or from the only one.
struct CellDraws {
    Lanes wi, p, radiance;
    alignas(4 * kLanes) float drawn[kLanes]; ///< density of the technique that drew the sample
    alignas(4 * kLanes) float other[kLanes]; ///< that of the other one

    void set(int lane, const LightSample<float>& sample, const Vec3<float>& point,
             const Vec3<float>& light) noexcept {
        wi.x[lane] = sample.wi.x;
        wi.y[lane] = sample.wi.y;
        wi.z[lane] = sample.wi.z;
        p.x[lane] = point.x;
        p.y[lane] = point.y;
        p.z[lane] = point.z;
        radiance.x[lane] = light.x;
        radiance.y[lane] = light.y;
        radiance.z[lane] = light.z;
        drawn[lane] = sample.pdf;
    }

    /// Sets some lanes.
    void set(LaneMask lanes, const LightSample<Real>& sample, const Vector& light,
             const Real& other_density) noexcept {
        const auto merge = [&](const Vector& value, Lanes& target) {
            target = store(select(lanes, value, load(target)));
        };
        merge(sample.wi, wi);
        merge(sample.p, p);
        merge(light, radiance);
        select(lanes, sample.pdf, Real::load(drawn)).store(drawn);
        select(lanes, other_density, Real::load(other)).store(other);
    }

    LightSample<Real> sample() const noexcept { return {load(wi), Real::load(drawn), load(p)}; }
};

/// A sample of a technique that takes two random numbers, or one.
template <class Technique, class Number>
auto sample_of(const Technique& technique, const Vec2<Number>& u) noexcept {
    if constexpr (requires { technique.sample(u); })
        return technique.sample(u);
    else
        return technique.sample(u.x);
}

/// Draws from the techniques of some lanes.
/// \param other_density density at a sample of the other technique of a pair, function of lane and sample
template <class Cells, class Technique, class OtherDensity>
void draw_cells(const Cells& cells, const LaneTechniques<Technique>& techniques, LaneMask lanes,
                const Vec2<Real>& u, const OtherDensity& other_density, CellDraws& draws) noexcept {
    float x[kLanes];
    float y[kLanes];
    u.x.store(x);
    u.y.store(y);
    const std::uint32_t bits = lanes.bits();
    for (int lane = 0; lane < kLanes; ++lane) {
        if ((bits >> lane & 1u) == 0 || !techniques.has(lane)) continue;
        const auto sample = sample_of(techniques[lane], Vec2<float>{x[lane], y[lane]});
        draws.set(lane, sample, cells.point(sample), cells.radiance(sample, lane));
        draws.other[lane] = sample.pdf != 0 ? other_density(lane, sample) : 0.0f;
    }
}

/// \copydoc draw_cells
/// \param other_density function of the sample
template <class Cells, class Technique, class OtherDensity>
void draw_cells(const Cells& cells, const PackTechnique<Technique>& technique, LaneMask lanes,
                const Vec2<Real>& u, const OtherDensity& other_density, CellDraws& draws) noexcept {
    const auto sample = sample_of(technique.technique, u);
    const LaneMask drawn = lanes & technique.present & (sample.pdf != Real(0));
    draws.set(drawn, {sample.wi, sample.pdf, cells.point(sample)}, cells.radiance(sample),
              other_density(sample));
}

/// Samples for all components of the BRDF. \param light with an emission of 1
template <class Cells, class Shape>
void add_by_cells(ReflectedLight& reflected, const Cells& cells, const LocalLight<Shape>& light) noexcept {
    const Surface& surface = reflected.surface();
    const auto techniques = cells.diffuse(light.lit);
    const auto no_other = [](const auto&...) { return 0.0f; };
    reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
        CellDraws draws{};
        draw_cells(cells, techniques, light.lit, reflected.random(light, number, kPointPair), no_other,
                   draws);
        DirectLightSample<Real> sample = reflect(surface, draws.sample());
        sample.shadowed = load(draws.radiance) * sample.shadowed;
        reflected.add_sample(light.shape, light.lit, sample, sum);
    });
}

/// A technique for each component.
template <class Cells>
class CellPair {
public:
    CellPair(const Cells& cells, const Surface& surface, LaneMask lit, LaneMask glossy) noexcept
        : surface_(surface.glossy),
          cells_(cells),
          diffuse_(cells.diffuse(lit)),
          specular_(cells.specular(glossy, surface.glossy.lobe)),
          techniques_{{Real(1), Real(1)},
                      {diffuse_.unshadowed() * albedo_for_mis(surface.glossy.diffuse_albedo),
                       specular_.unshadowed() * surface.glossy.specular_albedo}} {}

    template <class Heuristic>
    DirectLightSample<Real> sample_diffuse(const Heuristic& heuristic, LaneMask lanes,
                                           const Vec2<Real>& u) const noexcept {
        CellDraws draws{};
        draw_cells(cells_, diffuse_, lanes, u, density_of(specular_), draws);
        return estimate(
            draws, {Real::load(draws.drawn), Real::load(draws.other)},
            [&](const MisSample<Real, 2>& s) { return heuristic.template estimate<0>(techniques_, s); });
    }

    template <class Heuristic>
    DirectLightSample<Real> sample_specular(const Heuristic& heuristic, LaneMask lanes,
                                            const Vec2<Real>& u) const noexcept {
        CellDraws draws{};
        draw_cells(cells_, specular_, lanes, u, density_of(diffuse_), draws);
        return estimate(
            draws, {Real::load(draws.other), Real::load(draws.drawn)},
            [&](const MisSample<Real, 2>& s) { return heuristic.template estimate<1>(techniques_, s); });
    }

    DirectLightSample<Real> sample_one(LaneMask lanes, const Vec2<Real>& u) const noexcept {
        const OneSampleChoice<Real, 2> choice(techniques_);
        const auto decision = choice.decide(u.x);
        const Vec2<Real> v{decision.u, u.y};
        CellDraws draws{};
        draw_cells(cells_, diffuse_, lanes & decision.chosen[0], v, density_of(specular_), draws);
        draw_cells(cells_, specular_, lanes & decision.chosen[1], v, density_of(diffuse_), draws);
        const Real drawn = Real::load(draws.drawn);
        const Real other = Real::load(draws.other);
        return estimate(draws,
                        {select(decision.chosen[0], drawn, other), select(decision.chosen[0], other, drawn)},
                        [&](const MisSample<Real, 2>& s) { return choice.estimate(s); });
    }

private:
    template <class Technique>
    auto density_of(const LaneTechniques<Technique>& techniques) const noexcept {
        return [&](int lane, const auto& sample) {
            return techniques.has(lane) ? cells_.density(techniques[lane], sample) : 0.0f;
        };
    }

    template <class Technique>
    auto density_of(const PackTechnique<Technique>& technique) const noexcept {
        return [&](const auto& sample) {
            return select(technique.present, cells_.density(technique.technique, sample), Real(0));
        };
    }

    /// \param heuristic gives the estimate of a sample
    template <class Heuristic>
    DirectLightSample<Real> estimate(const CellDraws& draws, const Vec2<Real>& pdf,
                                     const Heuristic& heuristic) const noexcept {
        const LightSample<Real> sample = draws.sample();
        MisSample<Real, 2> densities = mis_sample(surface_, sample, pdf);
        for (Vector& component : densities.component) component = load(draws.radiance) * component;
        return direct_light_sample(sample, heuristic(densities));
    }

    const GlossySurface<Real, SurfaceBrdf>& surface_;
    const Cells& cells_;
    decltype(std::declval<const Cells&>().diffuse(LaneMask())) diffuse_;
    decltype(std::declval<const Cells&>().specular(LaneMask(), std::declval<const Ltc<Real>&>())) specular_;
    MisTechniques<Real, 2> techniques_;
};

/// Samples of a technique for each component. \param light with an emission of 1
template <class Cells, class Shape>
void add_by_cell_pair(ReflectedLight& reflected, const Cells& cells,
                      const LocalLight<Shape>& light) noexcept {
    const Surface& surface = reflected.surface();
    const LaneMask glossy = light.lit & surface.glossy.is_glossy();
    if (!any(glossy)) {
        add_by_cells(reflected, cells, light);
        return;
    }
    const render_cpu::RenderJob& job = reflected.job();
    const CellPair<Cells> pair(cells, surface, light.lit, glossy);
    if (job.mis == render::Mis::one_sample) {
        reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
            const auto u = reflected.random(light, number, kPointPair);
            reflected.add_sample(light.shape, light.lit, pair.sample_one(light.lit, u), sum);
        });
        return;
    }
    const ChosenHeuristic heuristic{job.mis, Real(job.visibility_estimate)};
    reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
        const auto u = reflected.random(light, number, kPointPair);
        reflected.add_sample(light.shape, light.lit, pair.sample_diffuse(heuristic, light.lit, u), sum);
        const auto v = reflected.random(light, number, kSpecularPointPair);
        reflected.add_sample(light.shape, glossy, pair.sample_specular(heuristic, glossy, v), sum);
    });
}

/// Closed-form shading: all of each cell has its mean radiance. \param light with an emission of 1
template <class Cells, class Shape>
void add_cell_integrals(ReflectedLight& reflected, const Cells& cells,
                        const LocalLight<Shape>& light) noexcept {
    const Surface& surface = reflected.surface();
    const Vector diffuse = cells.diffuse(light.lit).unshadowed() * surface.glossy.diffuse_albedo;
    const LaneMask glossy = light.lit & surface.glossy.is_glossy();
    Vector all = diffuse;
    if (any(glossy))
        all = all + cells.specular(glossy, surface.glossy.lobe).unshadowed() * surface.glossy.specular_albedo;
    reflected.add_known(light, {all, diffuse});
}

} // namespace kernel
NUSSELT_NAMESPACE_END
