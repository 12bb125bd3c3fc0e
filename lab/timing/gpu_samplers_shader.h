#pragma once
/// An entry of the table of shaders that the build generates.

#include "lab/timing/sampler_timing_kernel.h"

#include <cstdint>
#include <span>

namespace nusselt::lab {

struct GpuSamplerShader {
    const char* technique; ///< class name, or "Baseline"
    LightKind kind;
    int vertex_count; ///< 2 for lines
    bool directions;  ///< samples have neither density nor hit point
    std::span<const std::uint32_t> spirv;
};

} // namespace nusselt::lab
