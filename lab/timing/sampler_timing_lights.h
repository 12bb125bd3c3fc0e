#pragma once
/// The lights that samplers are timed with, on CPU and GPU, and what becomes of the times.

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

/// Everything that is timed.
std::vector<TimedConfiguration> timed_configurations();

/// Regular polygons (or segments) of random orientation; those at the zenith lie flat. The radius of cylinders is an
/// eighth of their length. All lights are on the same glossy lobe.
void make_timed_lights(const TimedConfiguration& c, TimedLights& lights);

/// The given share of the sorted values lies below the result.
double quantile(std::vector<double> values, double share);

/// The plain transcription that a technique competes with.
std::string competitor_of(const std::string& technique);

} // namespace nusselt::lab
