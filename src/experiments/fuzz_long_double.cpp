#include "experiments/fuzz_impl.h"

namespace nusselt::experiments {

FuzzTable<long double> fuzz_table_long_double() { return fuzz::table<long double>(); }

} // namespace nusselt::experiments
