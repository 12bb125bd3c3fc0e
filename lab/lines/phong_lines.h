#pragma once
/// Phong lobes along lines: cost and accuracy of quadrature, next to the recursion and the table of Billen and Dutre (2016).

#include "base/isa.h"

namespace nusselt::lab {

/// One way to integrate, in float on one thread.
struct PhongMethod {
    double nanoseconds = 0; ///< per part of a line, median
    /// Errors for parts of lines, over the integral of the lobe along the whole line.
    double median_error = 0, largest_error = 0;
};

struct PhongLineComparison {
    int lanes = 1; ///< of packed_quadrature
    PhongMethod packed_quadrature, quadrature, table, recursion;
};

/// Uses 256 random lines, each hit by the mirrored direction, and random parts of them.
/// \param exponent    at least 1.
/// \param repetitions at least 1, of the interleaved series.
PhongLineComparison compare_phong_lines(int exponent, int repetitions, base::Isa isa);

} // namespace nusselt::lab
