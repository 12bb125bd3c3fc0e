// Points on polygons with a texture.
//
// Samples in proportion to radiance times a measure come from a lattice of cells for each shading point, where cells are the
// lanes: shading points take turns. All that follows a sample has shading points as lanes again.

#include "render_cpu/kernel/lights/polygon_light.h"
#include "render_cpu/kernel/paired_techniques.h"

#include <nusselt/emission/textured_polygon.h>

#include <new>
#include <type_traits>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

constexpr int kCells = render_cpu::kTextureCells;
using DiffuseCells = TexturedPolygon<float, kCells>;
using SpecularCells = TexturedPolygonLtc<float, kCells>;

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

    bool has(int lane) const noexcept { return (present_ >> lane & 1u) != 0; }
    const Technique& operator[](int lane) const noexcept {
        return *reinterpret_cast<const Technique*>(bytes_ + lane * sizeof(Technique));
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

/// A sample for each shading point of a packet, from one technique of a pair or from the only one.
struct CellDraws {
    Lanes wi, p, radiance;
    alignas(4 * kLanes) float drawn[kLanes]; ///< density of the technique that drew the sample
    alignas(4 * kLanes) float other[kLanes]; ///< that of the other one

    void set(int lane, const TexturedSample<float>& sample, const Vec3<float>& light) noexcept {
        wi.x[lane] = sample.wi.x;
        wi.y[lane] = sample.wi.y;
        wi.z[lane] = sample.wi.z;
        p.x[lane] = sample.p.x;
        p.y[lane] = sample.p.y;
        p.z[lane] = sample.p.z;
        radiance.x[lane] = light.x;
        radiance.y[lane] = light.y;
        radiance.z[lane] = light.z;
        drawn[lane] = sample.pdf;
    }

    LightSample<Real> sample() const noexcept { return {load(wi), Real::load(drawn), load(p)}; }
};

/// A light with a texture as a packet of shading points sees it.
class CellLight {
public:
    CellLight(const render_cpu::PolygonTexture& texture, const Surface& surface) noexcept
        : texture_(texture), plane_(local_plane(texture, surface)) {}

    LaneTechniques<DiffuseCells> diffuse(LaneMask lanes) const noexcept {
        return {lanes, [&](int lane) { return DiffuseCells(plane(lane), cells()); }};
    }
    LaneTechniques<SpecularCells> specular(LaneMask lanes, const Ltc<Real>& lobe) const noexcept {
        return {lanes, [&](int lane) {
                    return SpecularCells(plane(lane), cells(), {single_lane<Ltc<float>>(lobe, lane)});
                }};
    }

    /// Draws from the techniques of some lanes, and asks others of these lanes, where there are any, for their density.
    template <class Technique, class Other>
    void draw(const LaneTechniques<Technique>& techniques, const LaneTechniques<Other>& others,
              LaneMask lanes, const Vec2<Real>& u, CellDraws& draws) const noexcept {
        draw(techniques, lanes, u, draws, [&](int lane, const TexturedSample<float>& sample) {
            return others.has(lane) ? others[lane].pdf_at(sample.at) : 0.0f;
        });
    }
    template <class Technique>
    void draw(const LaneTechniques<Technique>& techniques, LaneMask lanes, const Vec2<Real>& u,
              CellDraws& draws) const noexcept {
        draw(techniques, lanes, u, draws, [](int, const TexturedSample<float>&) { return 0.0f; });
    }

private:
    template <class Technique, class OtherDensity>
    void draw(const LaneTechniques<Technique>& techniques, LaneMask lanes, const Vec2<Real>& u,
              CellDraws& draws, const OtherDensity& other_density) const noexcept {
        float x[kLanes];
        float y[kLanes];
        u.x.store(x);
        u.y.store(y);
        const std::uint32_t bits = lanes.bits();
        for (int lane = 0; lane < kLanes; ++lane) {
            if ((bits >> lane & 1u) == 0 || !techniques.has(lane)) continue;
            const TexturedSample<float> sample = techniques[lane].sample({x[lane], y[lane]});
            draws.set(lane, sample, radiance_at(texture_, sample.at));
            draws.other[lane] = sample.pdf != 0 ? other_density(lane, sample) : 0.0f;
        }
    }

    TexturePlane<float> plane(int lane) const noexcept {
        return single_lane<TexturePlane<float>>(plane_, lane);
    }
    const TexturedLight<float, kCells>& cells() const noexcept {
        return *static_cast<const TexturedLight<float, kCells>*>(texture_.cells);
    }

    const render_cpu::PolygonTexture& texture_;
    TexturePlane<Real> plane_;
};

/// The same light for ReflectedLight. The radiance is part of each sample.
template <int N>
LocalLight<ConvexPolygon<Real, N>> white(const LocalLight<LocalPolygon<N>>& light) noexcept {
    return {light.shape, light.lit, {Real(1), Real(1), Real(1)}, light.number};
}

/// Samples for all components of the BRDF.
template <int N>
void add_by_cells(ReflectedLight& reflected, const LocalLight<LocalPolygon<N>>& textured) noexcept {
    const Surface& surface = reflected.surface();
    const CellLight cells(*textured.shape.texture, surface);
    const auto techniques = cells.diffuse(textured.lit);
    const auto light = white(textured);
    reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
        CellDraws draws{};
        cells.draw(techniques, light.lit, reflected.random(light, number, kPointPair), draws);
        DirectLightSample<Real> sample = reflect(surface, draws.sample());
        sample.shadowed = load(draws.radiance) * sample.shadowed;
        reflected.add_sample(light.shape, light.lit, sample, sum);
    });
}

/// A technique for each component.
class CellPair {
public:
    CellPair(const render_cpu::PolygonTexture& texture, const Surface& surface, LaneMask lit,
             LaneMask glossy) noexcept
        : surface_(surface.glossy),
          cells_(texture, surface),
          diffuse_(cells_.diffuse(lit)),
          specular_(cells_.specular(glossy, surface.glossy.lobe)),
          techniques_{{Real(1), Real(1)},
                      {diffuse_.unshadowed() * albedo_for_mis(surface.glossy.diffuse_albedo),
                       specular_.unshadowed() * surface.glossy.specular_albedo}} {}

    template <class Heuristic>
    DirectLightSample<Real> sample_diffuse(const Heuristic& heuristic, LaneMask lanes,
                                           const Vec2<Real>& u) const noexcept {
        CellDraws draws{};
        cells_.draw(diffuse_, specular_, lanes, u, draws);
        return estimate(
            draws, {Real::load(draws.drawn), Real::load(draws.other)},
            [&](const MisSample<Real, 2>& s) { return heuristic.template estimate<0>(techniques_, s); });
    }

    template <class Heuristic>
    DirectLightSample<Real> sample_specular(const Heuristic& heuristic, LaneMask lanes,
                                            const Vec2<Real>& u) const noexcept {
        CellDraws draws{};
        cells_.draw(specular_, diffuse_, lanes, u, draws);
        return estimate(
            draws, {Real::load(draws.other), Real::load(draws.drawn)},
            [&](const MisSample<Real, 2>& s) { return heuristic.template estimate<1>(techniques_, s); });
    }

    DirectLightSample<Real> sample_one(LaneMask lanes, const Vec2<Real>& u) const noexcept {
        const OneSampleChoice<Real, 2> choice(techniques_);
        const auto decision = choice.decide(u.x);
        const Vec2<Real> v{decision.u, u.y};
        CellDraws draws{};
        cells_.draw(diffuse_, specular_, lanes & decision.chosen[0], v, draws);
        cells_.draw(specular_, diffuse_, lanes & decision.chosen[1], v, draws);
        const Real drawn = Real::load(draws.drawn);
        const Real other = Real::load(draws.other);
        return estimate(draws,
                        {select(decision.chosen[0], drawn, other), select(decision.chosen[0], other, drawn)},
                        [&](const MisSample<Real, 2>& s) { return choice.estimate(s); });
    }

private:
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
    CellLight cells_;
    LaneTechniques<DiffuseCells> diffuse_;
    LaneTechniques<SpecularCells> specular_;
    MisTechniques<Real, 2> techniques_;
};

template <int N>
void add_by_cell_pair(ReflectedLight& reflected, const LocalLight<LocalPolygon<N>>& textured) noexcept {
    const Surface& surface = reflected.surface();
    const LaneMask glossy = textured.lit & surface.glossy.is_glossy();
    if (!any(glossy)) {
        add_by_cells(reflected, textured);
        return;
    }
    const render_cpu::RenderJob& job = reflected.job();
    const CellPair pair(*textured.shape.texture, surface, textured.lit, glossy);
    const auto light = white(textured);
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

/// Closed-form shading: all of each cell has its mean radiance.
template <int N>
void add_cell_integrals(ReflectedLight& reflected, const LocalLight<LocalPolygon<N>>& textured) noexcept {
    const Surface& surface = reflected.surface();
    const CellLight cells(*textured.shape.texture, surface);
    const Vector diffuse = cells.diffuse(textured.lit).unshadowed() * surface.glossy.diffuse_albedo;
    const LaneMask glossy = textured.lit & surface.glossy.is_glossy();
    Vector all = diffuse;
    if (any(glossy))
        all = all + cells.specular(glossy, surface.glossy.lobe).unshadowed() * surface.glossy.specular_albedo;
    reflected.add_known(white(textured), {all, diffuse});
}

template <int N, void (*add)(ReflectedLight&, const LocalLight<LocalPolygon<N>>&) noexcept>
void add_textured(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                  std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = PolygonLight<N>::local(reflected, lights, index);
    if (any(light.lit)) add(reflected, light);
}

template <int N>
render_cpu::AddLight choose_technique(const render_cpu::RenderJob& job) noexcept {
    using render::Strategies;
    using render::Technique;
    if (job.technique == Technique::ltc_analytic) return &add_textured<N, &add_cell_integrals<N>>;
    const bool is_projected = job.technique == Technique::projected_solid_angle ||
                              job.technique == Technique::projected_solid_angle_biased;
    if (job.emission_sampling == render::EmissionSampling::product && is_projected) {
        if (job.strategies == Strategies::diffuse) return &add_textured<N, &add_by_cells<N>>;
        if (job.strategies == Strategies::diffuse_ltc) return &add_textured<N, &add_by_cell_pair<N>>;
    }
    return polygon_points<N>(job);
}

} // namespace

template <>
render_cpu::AddLight textured_points<4>(const render_cpu::RenderJob& job) noexcept {
    return choose_technique<4>(job);
}
template <>
render_cpu::AddLight textured_points<8>(const render_cpu::RenderJob& job) noexcept {
    return choose_technique<8>(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
