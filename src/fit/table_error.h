#pragma once
/// The errors of lobes as an approximation of a BRDF.

#include "fit/brdf.h"

#include <nusselt/ltc/table.h>

#include <vector>

namespace nusselt::fit {

/// The matrix with unit vectors (m00, m02), as LtcTableView::entries has it.
LtcCoefficients<double> coefficients_of(const Lobe& lobe, double albedo);
/// The inverse of coefficients_of() for matrices of any scale.
Lobe lobe_of(const LtcCoefficients<double>& coefficients);

/// Integral of |BRDF times cosine / albedo - density of the lobe| over the sphere, in [0, 2].
double fit_error(const Brdf& brdf, const Slice& slice, const Lobe& lobe);

/// The fit_error() of interpolated lobes, in parallel on the threads of the current TBB arena.
std::vector<double> fit_errors(const Brdf& brdf, const LtcTableView& table, const std::vector<Slice>& slices);

/// Distribution of errors.
struct ErrorSummary {
    double mean, median, percentile_90, percentile_99, largest;
};

/// \param errors not empty.
ErrorSummary summary_of(std::vector<double> errors);

} // namespace nusselt::fit
