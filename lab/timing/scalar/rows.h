#pragma once

#include <vector>

#include "lab/timing/scalar/kernels.h"

namespace nusselt::lab {

/// All rows of the table: polygons of 3 to 7 corners, then lines.
std::vector<Row> scalar_rows();

} // namespace nusselt::lab
