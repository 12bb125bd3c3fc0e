#include "experiments/fuzz_impl.h"

namespace nusselt::experiments {

FuzzTable<float> fuzz_table_float_avx512() { return fuzz::table<Pack<float, kNativeLanes<float>>>(); }
FuzzTable<double> fuzz_table_double_avx512() { return fuzz::table<Pack<double, kNativeLanes<double>>>(); }

} // namespace nusselt::experiments
