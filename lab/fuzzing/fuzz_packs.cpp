/// Compiled once per instruction set; see fuzz.cpp.

#include "base/isa.h"
#include "lab/fuzzing/fuzz_impl.h"

namespace nusselt::lab {

template <>
FuzzTable<float> fuzz_table<base::Isa::NUSSELT_UNIT_ISA, float>() {
    return fuzz::table<Pack<float, kNativeLanes<float>>>();
}

template <>
FuzzTable<double> fuzz_table<base::Isa::NUSSELT_UNIT_ISA, double>() {
    return fuzz::table<Pack<double, kNativeLanes<double>>>();
}

} // namespace nusselt::lab
