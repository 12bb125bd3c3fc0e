#pragma once
/// The lights for timing samplers on CPU and GPU, and the evaluation of the times.

#include "lab/timing/sampler_timing_kernel.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// A class of lights in shading space, at a distance of about one.
struct TimedConfiguration {
    std::string name;
    LightKind kind;
    int vertex_count;
    double lowest, highest; ///< height of the centre
    double radius;          ///< half the extent of the light
    bool above_zenith;      ///< centred at the zenith
};

/// All classes of lights for which techniques are timed.
std::vector<TimedConfiguration> timed_configurations();

/// Regular polygons (or segments) of random orientation. Those at the zenith are horizontal. The radius of cylinders
/// is an eighth of their length. All lights are on the same glossy lobe.
void make_timed_lights(const TimedConfiguration& c, TimedLights& lights);

/// The value below which the given share of the values lies.
double quantile(std::vector<double> values, double share);

/// The class with which a technique competes: the one that follows the published formulas, or that of the technique that
/// it approximates. Empty if neither exists.
std::string competitor_of(const std::string& technique);

} // namespace nusselt::lab
