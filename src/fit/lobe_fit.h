#pragma once
/// Fits of single lobes.

#include "fit/brdf.h"

#include <vector>

namespace nusselt::fit {

struct FittedLobe {
    Lobe lobe;
    double albedo;
    double
        error; ///< integral of |BRDF times cosine / albedo - density of the lobe| over the sphere, in [0, 2],
               ///< of the BRDF that was fitted: for the smallest f0 not quite the one asked for
};

/// A lobe for each inclination of wo from 0 to pi / 2 in equal steps. Depends on nothing but the arguments.
///
/// For f0 below kSmallestF0 the shape is that of kSmallestF0: with Schlick's approximation, a surface that reflects
/// nothing at normal incidence has lost its peak and kept only the tail, and interpolation between both shapes would
/// be neither.
/// \param inclinations at least 2
std::vector<FittedLobe> fit_column(const Brdf& brdf, double roughness, double f0, int inclinations);

inline constexpr double kSmallestF0 = 1e-3;

} // namespace nusselt::fit
