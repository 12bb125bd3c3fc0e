/// Compiled once per instruction set; see shadow_fuzz.h.

#include "proof/shadows/shadow_checks.h"
#include "lab/fuzzing/shadow_fuzz.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

inline const char* parts_violation(const proof::ShadowCase& test) {
    float visible[proof::kLinesPerCase];
    return broken_parts(test, visible);
}

} // namespace shadows
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
ShadowChecks shadow_checks<base::Isa::NUSSELT_UNIT_ISA>() {
    return {shadows::leak, shadows::parts_violation};
}

} // namespace nusselt::lab
