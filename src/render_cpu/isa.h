#pragma once
/// Choice of the kernel for this processor.

#include "render_cpu/kernel.h"

#include <optional>
#include <string_view>

namespace nusselt::render_cpu {

/// Instruction sets that kernels exist for, from few to many lanes.
enum class Isa { sse42, avx2, avx512 };

/// "sse42", "avx2" or "avx512".
std::string_view name_of(Isa isa);

/// Whether processor and operating system support it.
bool is_supported(Isa isa);

/// The instruction set to use.
/// \param name its name; if absent, the environment variable NUSSELT_ISA, and if that is not set or empty,
/// the
///             largest one that is supported
/// \throws std::runtime_error if the name is unknown or the instruction set not supported
Isa choose_isa(std::optional<std::string_view> name = {});

/// The kernel, which must only be called where the instruction set is supported.
RenderTile kernel_for(Isa isa);

} // namespace nusselt::render_cpu
