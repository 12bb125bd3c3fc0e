#include "experiments/sampler_timing_impl.h"

namespace nusselt::experiments {

std::vector<TimedTechnique> timed_techniques_sse42() { return timing::techniques(); }

} // namespace nusselt::experiments
