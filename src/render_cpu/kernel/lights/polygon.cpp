#include "render_cpu/kernel/lights/polygon_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

void choose(const render_cpu::RenderJob& job, render_cpu::AddLight (&add)[render_cpu::kMostShapes]) noexcept {
    const bool has_lines = job.light_samples == render::LightSamples::lines;
    add[0] = has_lines ? polygon_lines<4>() : polygon_points<4>(job);
    add[1] = has_lines ? polygon_lines<8>() : polygon_points<8>(job);
}

std::int32_t shape_of(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    return polygon_record(lights, index).slots == 4 ? 0 : 1;
}

scene::Float3 emission(const render_cpu::LightSet& lights, std::int32_t index,
                       const scene::Float3& /*origin*/, const scene::Float3& direction) noexcept {
    const render_cpu::PolygonRecord& light = polygon_record(lights, index);
    const bool is_seen = light.two_sided != 0 || dot(to_vec(light.normal), to_vec(direction)) < 0;
    return is_seen ? light.radiance : scene::Float3{0, 0, 0};
}

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode polygon_code(LaneCount<kernel::kLanes>) {
    return {&kernel::choose, &kernel::shape_of, &kernel::emission};
}

} // namespace nusselt::render_cpu
