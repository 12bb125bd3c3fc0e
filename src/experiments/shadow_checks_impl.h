#pragma once
/// Compiled once per instruction set; see shadow_fuzz.h.

#include "experiments/shadow_fuzz.h"
#include "experiments/shadows/shadow_checks.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

inline const char* parts_violation(const ShadowCase& test) {
    float visible[kLinesPerCase];
    return broken_parts(test, visible);
}

inline constexpr experiments::ShadowChecks kChecks{leak, parts_violation};

} // namespace shadows
NUSSELT_NAMESPACE_END
