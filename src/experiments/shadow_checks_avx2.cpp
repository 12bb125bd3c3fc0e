#include "experiments/shadow_checks_impl.h"

namespace nusselt::experiments {

ShadowChecks shadow_checks_avx2() { return shadows::kChecks; }

} // namespace nusselt::experiments
