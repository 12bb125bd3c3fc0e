#include "lab/fuzzing/fuzz_impl.h"

namespace nusselt::lab {

FuzzTable<long double> fuzz_table_long_double() { return fuzz::table<long double>(); }

} // namespace nusselt::lab
