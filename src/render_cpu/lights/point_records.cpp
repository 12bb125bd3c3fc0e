#include "render_cpu/lights/point_records.h"

#include "render_cpu/lights/light_kernel.h"
#include "scene/model/scene.h"

namespace nusselt::render_cpu {

namespace {

PointRecord make_record(const scene::PointLight& light) {
    const scene::ConeFalloff falloff = cone_falloff(light);
    return {light.position,
            light.x_axis,
            light.y_axis,
            light.z_axis,
            light.intensity,
            light.distribution,
            static_cast<float>(falloff.end),
            scene::inverse_width(falloff),
            light.half_extent,
            light.texture};
}

} // namespace

std::shared_ptr<const void> make_point_records(const scene::Scene& scene, const scene::LightList& list) {
    return make_record_array<scene::PointLight, make_record>(scene, list);
}

} // namespace nusselt::render_cpu
