/// The techniques in double, compiled once per instruction set.
#include "python/kernels/techniques.h"

namespace nusselt::python {

template <>
std::span<const TechniqueRow<double>> technique_rows<base::Isa::NUSSELT_UNIT_ISA, double>() {
    return kernels::kTechniques<kernels::PackOf<double>>;
}

} // namespace nusselt::python
