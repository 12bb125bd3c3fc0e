#pragma once
/// Instruction sets that some units are compiled for more than once, and the choice between them at run time.

#include <array>
#include <optional>
#include <string_view>

namespace nusselt::base {

/// Instruction sets, ordered from few to many lanes.
enum class Isa { sse42, avx2, avx512 };

inline constexpr std::array kAllIsas = {Isa::sse42, Isa::avx2, Isa::avx512};

/// "sse42", "avx2" or "avx512".
std::string_view name_of(Isa isa);

/// The number of floats in a register.
constexpr int lane_count(Isa isa) {
    switch (isa) {
    case Isa::sse42:
        return 4;
    case Isa::avx2:
        return 8;
    case Isa::avx512:
        break;
    }
    return 16;
}

/// Whether processor and operating system support it.
bool is_supported(Isa isa);

/// The instruction set to use.
/// \param name its name; if absent, the environment variable NUSSELT_ISA, and if that is not set or empty, the
///             largest one that is supported
/// \throws std::runtime_error if the name is unknown or the instruction set not supported
Isa choose_isa(std::optional<std::string_view> name = {});

/// \throws std::logic_error
[[noreturn]] void report_unknown_isa();

/// Calls the instantiation of a templated function object for an instruction set, which must be supported.
///
/// A function that exists once per instruction set is declared as `template <base::Isa> Result work();`. The unit that
/// defines it is listed in nusselt_add_isa_units() of cmake/NusseltIsa.cmake, which compiles it once for each, and
/// specialises the template for base::Isa::NUSSELT_UNIT_ISA. Others call
/// `base::dispatch(isa, []<base::Isa chosen> { return work<chosen>(); })`.
template <class Function>
auto dispatch(Isa isa, const Function& function) {
    switch (isa) {
    case Isa::sse42:
        return function.template operator()<Isa::sse42>();
    case Isa::avx2:
        return function.template operator()<Isa::avx2>();
    case Isa::avx512:
        return function.template operator()<Isa::avx512>();
    }
    report_unknown_isa();
}

} // namespace nusselt::base
