/// The techniques in float, compiled once per instruction set.
#include "python/kernels/techniques.h"

namespace nusselt::python {

template <>
std::span<const TechniqueRow<float>> technique_rows<base::Isa::NUSSELT_UNIT_ISA, float>() {
    return kernels::kTechniques<kernels::PackOf<float>>;
}

} // namespace nusselt::python
