#pragma once
/// Working memory for line samples.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "visibility/line_traversal.h"

#include <type_traits>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Bound on the visible parts of lines that are traced alone.
inline constexpr int kPartsInMemory = render_cpu::kLineMemoryBytes / sizeof(Interval<Real>);
/// The same for lines that share the memory.
inline constexpr int kPartsPerLine = kPartsInMemory / kLargestLinePackCount;
/// How often lines with more parts are halved. The pieces get so short that single precision cannot tell more parts
/// of them apart.
inline constexpr int kMostHalvings = 16;

struct LineMemory {
    Interval<Real> parts[kPartsInMemory];
};
static_assert(std::is_trivially_copyable_v<LineMemory>, "renderers hand out bytes");

} // namespace kernel
NUSSELT_NAMESPACE_END
