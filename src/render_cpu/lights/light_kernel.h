#pragma once
/// The table of kinds of light of the CPU renderer.

#include "base/isa.h"
#include "render_cpu/kernel.h"
#include "scene/model/scene.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace nusselt::render_cpu {

/// A row of the table of kinds of light. Another kind is a unit in kernel/lights, compiled once for each instruction set, and
/// its row.
struct LightKernel {
    /// Makes the lights in the form that the code reads; null if the list is of another kind.
    /// \throws std::runtime_error if a light cannot be rendered
    std::shared_ptr<const void> (*make_records)(const scene::Scene& scene, const scene::LightList& lights);
    std::array<LightCode, 3> code; ///< in the order of Isa
    bool takes_lines = false;      ///< whether LightSamples::lines samples such lights by lines
};

std::span<const LightKernel> light_kernels();

/// LightKernel::make_records for kinds with one record per light. \tparam make_record makes the record of a light
template <class Light, auto make_record>
std::shared_ptr<const void> make_record_array(const scene::Scene& /*scene*/, const scene::LightList& list) {
    const auto* const lights = dynamic_cast<const scene::LightsOf<Light>*>(&list);
    if (lights == nullptr) return nullptr;
    using Record = decltype(make_record(lights->lights.front()));
    const auto records = std::make_shared<std::vector<Record>>();
    for (const Light& light : lights->lights) records->push_back(make_record(light));
    return {records, records->data()};
}

} // namespace nusselt::render_cpu
