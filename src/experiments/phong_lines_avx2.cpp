#include "experiments/phong_lines_impl.h"

namespace nusselt::experiments {

PhongEvaluation phong_evaluation_avx2() { return phong_lines::evaluation(); }

} // namespace nusselt::experiments
