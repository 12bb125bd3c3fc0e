#pragma once
/// The lights for timing samplers on CPU and GPU, and the evaluation of the times.

#include "lab/timing/sampler_timing_kernel.h"
#include "lab/timing/scalar/lights.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// Lights of one class and one kind.
struct TimedConfiguration {
    std::string name; ///< of the class, and the number of vertices of polygons
    LightKind kind;
    int vertex_count; ///< 2 for lines and cylinders, 4 for round lights
    LightClass lights;
};

/// All classes of lights for which techniques are timed.
std::vector<TimedConfiguration> timed_configurations();

/// Random lights of a class. The radius of cylinders is an eighth of their length. All lights are on the same glossy lobe.
/// \param seed other lights for each.
void make_timed_lights(const TimedConfiguration& c, unsigned seed, TimedLights& lights);

/// The class with which a technique competes: the one that follows the published formulas, or that of the technique that
/// it approximates. Empty if neither exists.
std::string competitor_of(const std::string& technique);

} // namespace nusselt::lab
