#pragma once
/// The row of discs in the table of the CPU renderer.

#include "disc.h"

#include "render_cpu/lights/light_kernel.h"

#include <vector>

namespace nusselt::render_cpu {

// In disc_kernel.cpp.
LightCode disc_code(LaneCount<4>), disc_code(LaneCount<8>), disc_code(LaneCount<16>);

inline scene::DiscLight disc_record(const scene::DiscLight& light) { return light; }

/// The kernels of the renderer and that of discs.
inline std::vector<LightKernel> kernels_with_discs() {
    std::vector<LightKernel> kernels(light_kernels().begin(), light_kernels().end());
    kernels.push_back({make_record_array<scene::DiscLight, disc_record>,
                       {disc_code(LaneCount<4>()), disc_code(LaneCount<8>()), disc_code(LaneCount<16>())},
                       false});
    return kernels;
}

} // namespace nusselt::render_cpu
