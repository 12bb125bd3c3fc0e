// Points on polygons with a texture.

#include "render_cpu/kernel/lights/cell_samples.h"
#include "render_cpu/kernel/lights/polygon_light.h"

#include <nusselt/emission/textured_polygon.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

constexpr int kCells = render_cpu::kTextureCells;
using DiffuseCells = TexturedPolygon<Real, kCells>;
using SpecularCells = TexturedPolygonLtc<Real, kCells>;

/// A light with a texture as a packet of shading points sees it, see cell_samples.h.
class TextureCells {
public:
    TextureCells(const render_cpu::PolygonTexture& texture, const Surface& surface) noexcept
        : texture_(texture), plane_(local_plane(texture, surface)) {}

    PackTechnique<DiffuseCells> diffuse(LaneMask lanes) const noexcept {
        return {lanes, DiffuseCells(plane_, light())};
    }
    PackTechnique<SpecularCells> specular(LaneMask lanes, const Ltc<Real>& lobe) const noexcept {
        return {lanes, SpecularCells(plane_, light(), {lobe})};
    }
    Vector radiance(const TexturedSample<Real>& sample) const noexcept {
        return radiance_at(texture_, sample.at);
    }
    Vector point(const TexturedSample<Real>& sample) const noexcept { return sample.p; }
    template <class Technique>
    Real density(const Technique& technique, const TexturedSample<Real>& sample) const noexcept {
        return technique.pdf_at(sample.at);
    }

private:
    const TexturedLight<float, kCells>& light() const noexcept {
        return *static_cast<const TexturedLight<float, kCells>*>(texture_.cells);
    }

    const render_cpu::PolygonTexture& texture_;
    TexturePlane<Real> plane_;
};

template <int N>
using White = LocalLight<ConvexPolygon<Real, N>>;

template <int N, void (*add)(ReflectedLight&, const TextureCells&, const White<N>&) noexcept>
void add_textured(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                  std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = PolygonLight<N>::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const TextureCells cells(*light.shape.texture, reflected.surface());
    // The radiance is part of each sample.
    const White<N> white{light.shape, light.lit, {Real(1), Real(1), Real(1)}, light.number};
    add(reflected, cells, white);
}

template <int N>
render_cpu::AddLight choose_technique(const render_cpu::RenderJob& job) noexcept {
    using render::Strategies;
    if (job.technique == render::Technique::ltc_analytic) return &add_textured<N, &add_cell_integrals>;
    if (takes_products(job)) {
        if (job.strategies == Strategies::diffuse) return &add_textured<N, &add_by_cells>;
        if (job.strategies == Strategies::diffuse_ltc) return &add_textured<N, &add_by_cell_pair>;
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
