#pragma once
/// Working memory for line samples.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "visibility/line_traversal.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Packs of lines whose visible parts are found at once.
inline constexpr int kPacksPerBatch = 8;
/// Bound on the visible parts of a line.
inline constexpr int kPartsPerLine = 64;

struct LineMemory {
    Interval<Real> parts[kPacksPerBatch][kPartsPerLine];
};
static_assert(sizeof(LineMemory) <= render_cpu::kLineMemoryBytes, "renderers reserve less");
static_assert(kPacksPerBatch <= kLargestLinePackCount, "more than are traced at once");

} // namespace kernel
NUSSELT_NAMESPACE_END
