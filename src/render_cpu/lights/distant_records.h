#pragma once
/// Distant lights in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/kernel.h"

#include <memory>

namespace nusselt::render_cpu {

struct DistantRecord {
    scene::Float3 to_light; ///< unit
    scene::Float3 irradiance;
};

/// Makes an array of DistantRecord, see LightKernel.
std::shared_ptr<const void> make_distant_records(const scene::Scene& scene, const scene::LightList& list);

// In kernel/lights/distant.cpp.
LightCode distant_code(LaneCount<4>), distant_code(LaneCount<8>), distant_code(LaneCount<16>);

} // namespace nusselt::render_cpu
