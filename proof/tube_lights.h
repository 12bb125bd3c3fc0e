#pragma once
/// Closed cylinders for unit tests and `nusselt-lab bench tubes`, one for each case that their sampling
/// distinguishes.

#include <nusselt/core/vec.h>
#include <nusselt/ltc/coefficients.h>

#include <string>
#include <vector>

namespace nusselt::proof {

/// A light in shading space: the shading point is the origin, the normal +z.
struct TubeLight {
    std::string name;
    Vec3<double> begin, end; ///< of the axis [m]
    double radius;           ///< [m]
};

/// Lights seen from the side and from in front of a cap, and cut by the horizon in every way. All but "close" are
/// exact in float.
inline std::vector<TubeLight> tube_lights() {
    return {
        {"above", {-1, 2, 0.5}, {1.5, 1, 1.25}, 0.3125},
        {"end-on", {0.5, 0.25, 1}, {4, 0.5, 1.25}, 0.375},
        {"through the floor", {1, -1, -0.5}, {1, 1, 0.75}, 0.625},
        {"vertical", {0.25, 0, 1}, {0.25, 0, 3}, 0.1875},
        {"close", {-1, 0.625, 0.375}, {1, 0.625, 0.375}, 0.6},
        {"before a cap", {0.125, 0, 1}, {0.25, 0.125, 3}, 0.5},
        {"before a cap, backwards", {0.25, 0.125, 3}, {0.125, 0, 1}, 0.5},
        {"before a cap, through the floor", {0.5, 0, 0.25}, {3, 0, -0.25}, 0.5},
        {"before a cap, half below", {0.625, 0, -0.125}, {2, 0, -0.125}, 0.5},
        {"before a wide cap", {0.125, 0.5, 0.25}, {1, 0.5, 0.5}, 4},
        {"thin", {-1, 0.5, 1}, {1, 0.5, 1}, 0.0078125},
        {"mostly below", {1, -1, -0.25}, {1, 1, -0.125}, 0.375},
        {"long and close", {-50, 0.25, 0.5}, {70, 0.25, 0.625}, 0.25},
    };
}

/// A lobe that overlaps all of these lights. It is exact in float.
inline constexpr LtcCoefficients<double> kGlossyLobe = {0.875, -0.4375, 1.25, 0.15625, 0.375, 1};

} // namespace nusselt::proof
