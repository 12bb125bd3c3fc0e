#include "render_cpu/lights/line_records.h"

#include "render_cpu/lights/light_kernel.h"
#include "scene/model/library_vector.h"
#include "scene/model/scene.h"

#include <nusselt/geometry/line_segment.h>

namespace nusselt::render_cpu {

namespace {

LineRecord make_record(const scene::LineLight& light) {
    const auto line = make_line(to_vec(light.start), to_vec(light.end));
    return {scene::to_float3(line.p0),
            scene::to_float3(line.s),
            line.length,
            light.radius,
            light.model,
            light.normal,
            light.radiance,
            scene::to_float3(light.radius * to_vec(light.radiance))};
}

} // namespace

std::shared_ptr<const void> make_line_records(const scene::Scene& scene, const scene::LightList& list) {
    return make_record_array<scene::LineLight, make_record>(scene, list);
}

} // namespace nusselt::render_cpu
