#pragma once
/// Whether the device rounds `fma` once.

#include "gpu/device.h"

namespace nusselt::gpu {

/// Runs nusselt_fma_is_fused() of shaders/nusselt on the device. Shaders take exact products from a fused fma, and split
/// numbers where it rounds twice: shaders/interface/fused_fma.h tells them.
bool has_fused_fma(const Device& device);

} // namespace nusselt::gpu
