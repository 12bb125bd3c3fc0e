// Tubes and lines whose radiance varies along them.

#include "render_cpu/kernel/lights/cell_samples.h"
#include "render_cpu/kernel/lights/line_light.h"
#include "render_cpu/kernel/lights/tube_integrals.h"

#include <nusselt/line_emission/textured_tube.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

using DiffuseCells = TexturedLine<Real, scene::kMaxLineTexels>;
using SpecularCells = TexturedLineLtc<Real, scene::kMaxLineTexels>;

/// A light as a packet of shading points sees it, see cell_samples.h.
class LineCells {
public:
    LineCells(const LineRadiance& profile, const LineSegment<Real>& line) noexcept
        : profile_(profile), line_(line) {}

    PackTechnique<DiffuseCells> diffuse(LaneMask lanes) const noexcept {
        return {lanes, DiffuseCells(line_, profile_)};
    }
    PackTechnique<SpecularCells> specular(LaneMask lanes, const Ltc<Real>& lobe) const noexcept {
        return {lanes, SpecularCells(line_, profile_, {lobe})};
    }
    Vector radiance(const LineTextureSample<Real>& sample) const noexcept {
        return profile_.lookup(sample.at);
    }
    Vector point(const LineTextureSample<Real>& sample) const noexcept { return sample.p; }
    template <class Technique>
    Real density(const Technique& technique, const LineTextureSample<Real>& sample) const noexcept {
        return technique.pdf_at(sample.at);
    }

private:
    const LineRadiance& profile_;
    const LineSegment<Real>& line_;
};

using LocalLineLight = LocalLight<LineSegment<Real>>;

template <void (*add)(ReflectedLight&, const LineCells&, const LocalLineLight&) noexcept>
void add_textured_line(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                       std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = LinearLight::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const LineCells cells(*light.shape.radiance.profile, light.shape);
    // The radiance is part of each sample: what is left is the radius, and how strips face the point.
    const Vector scale = broadcast<Real>(light.shape.radiance.inverse_mean) * light.emission;
    const Real width = max(max(scale.x, scale.y), scale.z);
    add(reflected, cells, {light.shape, light.lit, {width, width, width}, light.number});
}

template <class Technique>
auto along(const Technique& technique, const Tube& tube) noexcept {
    return TexturedTube<Real, Technique>(technique, tube, *tube.radiance.profile);
}

/// The pair of tubes of a finite radius, see strategies.h.
struct TexturedTubes : CosineMeasures {
    template <class S>
    static auto diffuse(const Tube& tube, const S& /*surface*/) noexcept {
        return along(CylinderProjectedSolidAngle<Real>(tube), tube);
    }
    template <class S>
    static auto specular(const Tube& tube, const S& surface) noexcept {
        return along(CylinderLtc<Real>(tube, surface.lobe), tube);
    }
};

void add_by_textured_tube(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                          std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = TubeLight::local(reflected, lights, index);
    if (any(light.lit))
        add_samples(reflected, light, TexturedTubes::diffuse(light.shape, reflected.surface().glossy));
}

void add_textured_tube_integrals(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                                 std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = TubeLight::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const LineRadiance& profile = *light.shape.radiance.profile;
    const LineSegment<Real>& axis = light.shape.axis;
    const LineCells cells(profile, axis);
    const auto sees_start = dot(axis.p0, axis.s) > Real(0);
    const Vector on_cap =
        select(sees_start, broadcast<Real>(profile.lookup(0.0f)), broadcast<Real>(profile.lookup(1.0f)));
    const Real one(1);
    const LocalLight<Tube> plain{light.shape, light.lit, {one, one, one}, light.number};
    add_tube_integrals(reflected, plain, cells, on_cap);
}

} // namespace

render_cpu::AddLight textured_lines(const render_cpu::RenderJob& job) noexcept {
    if (job.technique == render::Technique::ltc_analytic) return &add_textured_line<&add_cell_integrals>;
    if (!takes_products(job)) return line_points(job);
    // Lines and tubes have no samples of the BRDF: other strategies take a single technique.
    return job.strategies == render::Strategies::diffuse_ltc ? &add_textured_line<&add_by_cell_pair>
                                                             : &add_textured_line<&add_by_cells>;
}

render_cpu::AddLight textured_tubes(const render_cpu::RenderJob& job) noexcept {
    if (job.technique == render::Technique::ltc_analytic) return &add_textured_tube_integrals;
    if (!takes_products(job)) return tube_points(job);
    return job.strategies == render::Strategies::diffuse_ltc ? &add_by_pair<TubeLight, TexturedTubes>
                                                             : &add_by_textured_tube;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
