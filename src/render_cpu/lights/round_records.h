#pragma once
/// Round lights in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/kernel.h"
#include "scene/model/lights/round/round_form.h"

#include <memory>

namespace nusselt::render_cpu {

using scene::RoundShape;
using RoundRecord = scene::RoundForm;

/// Makes an array of RoundRecord, see LightKernel.
std::shared_ptr<const void> make_round_records(const scene::Scene& scene, const scene::LightList& list);

// In kernel/lights/round.cpp.
LightCode round_code(LaneCount<4>), round_code(LaneCount<8>), round_code(LaneCount<16>);

} // namespace nusselt::render_cpu
