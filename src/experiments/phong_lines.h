#pragma once
/// Phong lobes along lines: cost and accuracy of quadrature, next to the recursion and the table of Billen and Dutre (2016).

#include <optional>
#include <string>
#include <string_view>

namespace nusselt::experiments {

/// One way to integrate, in float on one thread.
struct PhongMethod {
    double nanoseconds = 0; ///< per part of a line, median
    /// Of parts of lines, over the integral of the lobe over the whole line.
    double median_error = 0, largest_error = 0;
};

struct PhongLineComparison {
    std::string isa; ///< instruction set the code was compiled for
    int lanes = 1;   ///< of packed_quadrature
    PhongMethod packed_quadrature, quadrature, table, recursion;
};

/// For 256 random lines, each hit by the mirrored direction, and random parts of them.
/// \param exponent    at least 1.
/// \param repetitions at least 1, of the interleaved series.
/// \param isa         as render_cpu::choose_isa().
/// \throws std::runtime_error for an instruction set that is unknown or that the CPU lacks.
PhongLineComparison compare_phong_lines(int exponent, int repetitions,
                                        std::optional<std::string_view> isa = {});

} // namespace nusselt::experiments
