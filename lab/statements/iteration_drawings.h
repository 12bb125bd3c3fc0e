#pragma once
/// Drawings of starts and iterations in sectors: C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, Fig. 5 and 8.

#include "lab/statements/sector_iterations.h"

#include <string>

namespace nusselt::lab {

/// Samples of Arvo's method at equal steps of the random number.
inline constexpr int kArvoSamples = 48;
inline double share_of_sample(int k) { return (k + 0.5) / kArvoSamples; }

/// On which the cubic polynomial of Arvo does not rise.
TwoEllipses<double> uneven_sector();
/// In which Newton's method sends some samples into cycles.
TwoEllipses<double> cyclic_sector();

/// Two sectors, sampled with two quads and with one.
std::string draw_quads();

/// The uneven sector with starts, the cyclic one with samples after many steps, both with where the samples belong.
std::string draw_arvo();

} // namespace nusselt::lab
