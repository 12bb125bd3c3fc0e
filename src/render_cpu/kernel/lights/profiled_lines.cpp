// Tubes and lines whose radiance depends on the direction.

#include "render_cpu/kernel/lights/cell_samples.h"
#include "render_cpu/kernel/lights/line_light.h"
#include "render_cpu/kernel/lights/tube_integrals.h"
#include "render_cpu/kernel/point_samples.h"

#include <nusselt/line_emission/line_nodes.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

constexpr int kCells = 32;
using Nodes = LineNodes<float, kCells>;
using DiffuseCells = TexturedLine<float, kCells, ProjectedLines<float>, Nodes>;
using SpecularCells = TexturedLine<float, kCells, LobeLines<float>, Nodes>;

/// A light as a packet of shading points sees it, see cell_samples.h. Radiance is relative to its mean.
class DirectionCells {
public:
    /// \param lanes that see the light
    DirectionCells(const render_cpu::LineRecord& record, const LineSegment<Real>& line,
                   const Surface& surface, LaneMask lanes) noexcept
        : record_(record), line_(line), frame_(surface.frame) {
        const std::uint32_t bits = lanes.bits();
        for (int lane = 0; lane < kLanes; ++lane)
            if ((bits >> lane & 1u) != 0)
                nodes_[lane] = make_line_nodes<kCells>(
                    this->line(lane), 1.0f, [&](const Vec3<float>& wi) { return radiance_of(wi, lane); });
    }

    LaneTechniques<DiffuseCells> diffuse(LaneMask lanes) const noexcept {
        return {lanes, [&](int lane) { return DiffuseCells(line(lane), nodes_[lane]); }};
    }
    LaneTechniques<SpecularCells> specular(LaneMask lanes, const Ltc<Real>& lobe) const noexcept {
        return {lanes, [&](int lane) {
                    return SpecularCells(line(lane), nodes_[lane], {single_lane<Ltc<float>>(lobe, lane)});
                }};
    }
    Vec3<float> radiance(const LineTextureSample<float>& sample, int lane) const noexcept {
        return radiance_of(sample.wi, lane);
    }
    Vec3<float> point(const LineTextureSample<float>& sample) const noexcept { return sample.p; }
    template <class Technique>
    float density(const Technique& technique, const LineTextureSample<float>& sample) const noexcept {
        return technique.pdf_at(sample.at);
    }

private:
    LineSegment<float> line(int lane) const noexcept { return single_lane<LineSegment<float>>(line_, lane); }
    Vec3<float> radiance_of(const Vec3<float>& wi, int lane) const noexcept {
        const float value = radiance_of_line(record_, single_lane<Frame<float>>(frame_, lane).to_world(-wi));
        return {value, value, value};
    }

    const render_cpu::LineRecord& record_;
    const LineSegment<Real>& line_;
    const Frame<Real>& frame_;
    Nodes nodes_[kLanes];
};

using LocalLineLight = LocalLight<LineSegment<Real>>;

template <void (*add)(ReflectedLight&, const DirectionCells&, const LocalLineLight&) noexcept>
void add_profiled_line(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                       std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = LinearLight::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const DirectionCells cells(*light.shape.record, light.shape, reflected.surface(), light.lit);
    add(reflected, cells, {light.shape, light.lit, light.emission, light.number});
}

void add_profiled_tube_integrals(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                                 std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = TubeLight::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const LineSegment<Real>& axis = light.shape.axis;
    const render_cpu::LineRecord& record = line_record(lights, index);
    const Surface& surface = reflected.surface();
    const DirectionCells cells(record, axis, surface, light.lit);
    // The cap that is seen, from its centre.
    const Vector centre = select(dot(axis.p0, axis.s) > Real(0), axis.p0, end_of(axis));
    const Vector away = surface.frame.to_world(-normalize(centre));
    alignas(4 * kLanes) float on_cap[kLanes];
    for (int i = 0; i < kLanes; ++i) {
        const Vec3<float> direction = single_lane<Vec3<float>>(away, i);
        on_cap[i] = spread_share(*record.directions, to_vec(record.direction), direction) *
                    luminance_of_line(*record.directions, direction);
    }
    const Real cap = Real::load(on_cap);
    add_tube_integrals(reflected, light, cells, {cap, cap, cap});
}

} // namespace

render_cpu::AddLight profiled_lines(const render_cpu::RenderJob& job) noexcept {
    if (job.technique == render::Technique::ltc_analytic) return &add_profiled_line<&add_cell_integrals>;
    if (!takes_products(job)) return line_points(job);
    // Lines and tubes have no samples of the BRDF: other strategies take a single technique.
    return job.strategies == render::Strategies::diffuse_ltc ? &add_profiled_line<&add_by_cell_pair>
                                                             : &add_profiled_line<&add_by_cells>;
}

render_cpu::AddLight profiled_tubes(const render_cpu::RenderJob& job) noexcept {
    return job.technique == render::Technique::ltc_analytic ? &add_profiled_tube_integrals : tube_points(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
