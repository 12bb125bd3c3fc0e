#include "render_cpu/lights/distant_records.h"

#include "render_cpu/lights/light_kernel.h"
#include "scene/model/scene.h"

namespace nusselt::render_cpu {

namespace {

DistantRecord make_record(const scene::DistantLight& light) {
    const scene::Float3& way = light.direction;
    return {{-way.x, -way.y, -way.z}, light.irradiance};
}

} // namespace

std::shared_ptr<const void> make_distant_records(const scene::Scene& scene, const scene::LightList& list) {
    return make_record_array<scene::DistantLight, make_record>(scene, list);
}

} // namespace nusselt::render_cpu
