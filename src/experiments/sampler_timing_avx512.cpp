#include "experiments/sampler_timing_impl.h"

namespace nusselt::experiments {

std::vector<TimedTechnique> timed_techniques_avx512() { return timing::techniques(); }

} // namespace nusselt::experiments
