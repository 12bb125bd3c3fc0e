#pragma once
/// The measurements of all sets of statements. Each is deterministic.

#include "lab/statements/statement_set.h"

namespace nusselt::lab {

/// Closed forms for linear lights beside quadrature (reference_integrals.h).
Findings measure_closed_forms(Effort effort);

/// Lights of finite thickness whose thickness tends to zero.
Findings measure_thin_lights(Effort effort);

/// Sorting networks, arctangents and maps of random numbers that techniques are made of.
Findings measure_parts(Effort effort);

/// Where samples of fitted lobes go.
Findings measure_lobe_samples(Effort effort);

/// Heuristics for two techniques where the lobes are exact, and with smallest diffuse albedos.
Findings measure_heuristics(Effort effort);

/// How the variance of warped solid angle sampling depends on the order of vertices.
Findings measure_warps(Effort effort);

/// Starts and steps of iterations: quads in a sector, Arvo's polynomial and Newton's method, and orders of convergence.
Findings measure_iterations(Effort effort);

/// Maps to a polygon that is not convex, by azimuth as in Arvo 2001 and by convex parts.
Findings measure_non_convex(Effort effort);

/// The inverse distribution of lines: C. Peters 2021, BRDF Importance Sampling for Linear Lights, Fig. 3.
Findings measure_inverse_distribution(Effort effort);

} // namespace nusselt::lab
