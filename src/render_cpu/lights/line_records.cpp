#include "render_cpu/lights/line_records.h"

#include "render_cpu/lights/light_kernel.h"
#include "scene/model/scene.h"

#include <nusselt/geometry/line_segment.h>

namespace nusselt::render_cpu {

namespace {

Vec3<float> to_vec(const scene::Float3& v) { return {v.x, v.y, v.z}; }
scene::Float3 to_float3(const Vec3<float>& v) { return {v.x, v.y, v.z}; }

LineRecord make_record(const scene::LineLight& light) {
    const auto line = make_line(to_vec(light.start), to_vec(light.end));
    return {to_float3(line.p0),
            to_float3(line.s),
            line.length,
            light.radius,
            light.model,
            light.radiance,
            to_float3(light.radius * to_vec(light.radiance))};
}

} // namespace

std::shared_ptr<const void> make_line_records(const scene::Scene& scene, const scene::LightList& list) {
    return make_record_array<scene::LineLight, make_record>(scene, list);
}

} // namespace nusselt::render_cpu
