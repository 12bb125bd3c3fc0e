/// Functions of the library in both number types, compiled once per instruction set.
#include "python/kernels/function_kernels.h"

namespace nusselt::python {

template <>
std::span<const FunctionRow<float>> function_rows<base::Isa::NUSSELT_UNIT_ISA, float>() {
    return kernels::kFunctions<kernels::PackOf<float>>;
}
template <>
std::span<const FunctionRow<double>> function_rows<base::Isa::NUSSELT_UNIT_ISA, double>() {
    return kernels::kFunctions<kernels::PackOf<double>>;
}

} // namespace nusselt::python
