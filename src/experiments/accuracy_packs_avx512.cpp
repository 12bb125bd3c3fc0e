#include "experiments/accuracy_packs_impl.h"

namespace nusselt::experiments {

PackedTechniques packed_techniques_avx512() {
    return {accuracy::kTechniques, sizeof(accuracy::kTechniques) / sizeof(accuracy::kTechniques[0])};
}

} // namespace nusselt::experiments
