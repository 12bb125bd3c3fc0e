#include "render_cpu/kernel/lights/round_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

void choose(const render_cpu::RenderJob& job, render_cpu::AddLight (&add)[render_cpu::kMostShapes]) noexcept {
    const auto set = [&](render_cpu::RoundShape shape, render_cpu::AddLight points) {
        add[static_cast<std::int32_t>(shape)] = points;
    };
    set(render_cpu::RoundShape::sphere, sphere_points(job));
    set(render_cpu::RoundShape::disk, disk_points(job));
    set(render_cpu::RoundShape::ellipse, ellipse_points(job));
    set(render_cpu::RoundShape::ellipsoid, ellipsoid_points(job));
}

std::int32_t shape_of(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    return static_cast<std::int32_t>(round_record(lights, index).shape);
}

/// Whether a ray sees the inner side, or that to which the normal does not point.
bool sees_inner_side(const render_cpu::RoundRecord& record, const scene::Float3& origin,
                     const scene::Float3& direction) noexcept {
    if (record.shape == render_cpu::RoundShape::disk || record.shape == render_cpu::RoundShape::ellipse)
        return !(dot(to_vec(record.normal), to_vec(direction)) < 0);
    const Vec3<float> unit = in_unit_sphere(record, to_vec(origin) - to_vec(record.center));
    return dot(unit, unit) < 1;
}

scene::Float3 emission(const render_cpu::LightSet& lights, std::int32_t index, const scene::Float3& origin,
                       const scene::Float3& direction) noexcept {
    const render_cpu::RoundRecord& record = round_record(lights, index);
    const bool is_seen =
        (sees_inner_side(record, origin, direction) ? record.emits_inwards : record.emits_outwards) != 0;
    return is_seen ? record.radiance : scene::Float3{0, 0, 0};
}

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode round_code(LaneCount<kernel::kLanes>) {
    return {&kernel::choose, &kernel::shape_of, &kernel::emission};
}

} // namespace nusselt::render_cpu
