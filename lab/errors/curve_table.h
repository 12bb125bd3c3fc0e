#pragma once
/// Curves of noise as result tables.

#include "lab/errors/noise_curve.h"
#include "lab/results/results.h"

#include <vector>

namespace nusselt::lab {

/// Columns that name a curve, and those that append_curve() fills.
std::vector<Column> curve_columns(std::vector<Column> names);

/// Adds a row for each point of a curve.
/// \param names of the curve, for the first columns
/// \param mean  radiance that errors are relative to
void append_curve(const std::vector<Cell>& names, const NoiseCurve& curve, double mean, ResultTable& table);

} // namespace nusselt::lab
