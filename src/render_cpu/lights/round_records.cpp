#include "render_cpu/lights/round_records.h"

#include "render_cpu/lights/light_kernel.h"
#include "scene/model/scene.h"

#include <vector>

namespace nusselt::render_cpu {

std::shared_ptr<const void> make_round_records(const scene::Scene& scene, const scene::LightList& list) {
    if (dynamic_cast<const scene::LightsOf<scene::RoundLight>*>(&list) == nullptr) return nullptr;
    const auto records = std::make_shared<std::vector<RoundRecord>>(round_forms(scene));
    return {records, records->data()};
}

} // namespace nusselt::render_cpu
