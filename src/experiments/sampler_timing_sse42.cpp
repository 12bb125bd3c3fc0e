#include "experiments/sampler_timing_impl.h"

namespace nusselt::experiments {

TimedTechniques timed_techniques_sse42() {
    return {timing::kTechniques, sizeof(timing::kTechniques) / sizeof(timing::kTechniques[0])};
}

} // namespace nusselt::experiments
