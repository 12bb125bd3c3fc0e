#pragma once
/// Choice of the instruction set for this processor.

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

} // namespace nusselt::render_cpu
