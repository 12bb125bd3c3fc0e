#include "base/isa.h"
#include "base/words.h"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::base {

namespace {

/// \param origin of the name, for messages: empty or one that ends in ": "
Isa parse_isa(std::string_view name, const std::string& origin) {
    std::vector<std::string> known;
    for (const Isa isa : kAllIsas) {
        known.emplace_back(name_of(isa));
        if (name != name_of(isa)) continue;
        if (!is_supported(isa))
            throw std::runtime_error(origin + "the instruction set " + std::string(name) +
                                     " is not supported by this processor");
        return isa;
    }
    throw std::runtime_error(origin + "unknown instruction set '" + std::string(name) + "'; use " +
                             listing(known, "or"));
}

} // namespace

std::string_view name_of(Isa isa) {
    switch (isa) {
    case Isa::sse42:
        return "sse42";
    case Isa::avx2:
        return "avx2";
    case Isa::avx512:
        return "avx512";
    }
    return {};
}

// GCC's function asks the processor and, for the registers of AVX, the operating system. All that the levels
// v2, v3 and v4 of x86-64 add comes with the features named here on every processor made so far, except for
// what is asked for explicitly.
bool is_supported(Isa isa) {
    const bool sse42 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
    const bool avx2 = sse42 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    switch (isa) {
    case Isa::sse42:
        return sse42;
    case Isa::avx2:
        return avx2;
    case Isa::avx512:
        return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    }
    return false;
}

Isa choose_isa(std::optional<std::string_view> name) {
    if (name) return parse_isa(*name, "");
    if (const char* variable = std::getenv("NUSSELT_ISA"); variable != nullptr && *variable != '\0')
        return parse_isa(variable, "NUSSELT_ISA: ");
    for (auto isa = kAllIsas.rbegin(); isa != kAllIsas.rend(); ++isa)
        if (is_supported(*isa)) return *isa;
    throw std::runtime_error("this processor is not supported because it lacks SSE 4.2 or POPCNT");
}

void report_unknown_isa() { throw std::logic_error("this instruction set has no kernels"); }

} // namespace nusselt::base
