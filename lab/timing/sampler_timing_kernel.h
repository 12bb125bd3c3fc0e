#pragma once
/// The interface of the units compiled per instruction set to sampler_timing.cpp: plain data and functions.

#include "base/isa.h"

#include <vector>

namespace nusselt::lab {

inline constexpr int kTimedLights = 256;
inline constexpr int kLargestVertexCount = 8;

/// Lights and random numbers, one column per light. Polygons with fewer vertices repeat the last one; lines and the axes
/// of cylinders have two vertices.
struct TimedLights {
    float coordinates[kLargestVertexCount][3][kTimedLights]; ///< in shading space [m]
    float world[kLargestVertexCount][3][kTimedLights];       ///< of the same lights [m]
    float point[3][kTimedLights];                            ///< shading points [m]
    float normal[3][kTimedLights];                           ///< at the shading points
    float radius[kTimedLights];                              ///< of cylinders [m]
    float lobe[6][kTimedLights];                             ///< the members of LtcCoefficients in order
    float u[2][kTimedLights];
};

/// The names are those in techniques.json.
enum class LightKind { polygon, polygon_on_lobe, line, line_on_lobe, cylinder, cylinder_on_lobe };

constexpr bool is_polygon(LightKind kind) {
    return kind == LightKind::polygon || kind == LightKind::polygon_on_lobe;
}

constexpr bool is_cylinder(LightKind kind) {
    return kind == LightKind::cylinder || kind == LightKind::cylinder_on_lobe;
}
constexpr bool has_lobe(LightKind kind) {
    return kind == LightKind::polygon_on_lobe || kind == LightKind::line_on_lobe ||
           kind == LightKind::cylinder_on_lobe;
}

struct TimedTechnique {
    const char* name;
    LightKind kind;
    int lanes;
    int vertex_count; ///< the bound on the number of vertices; 2 for lines and cylinders
    /// Converts the lights to the type of the technique. Must be called first.
    void (*load)(const TimedLights&);
    /// Prepares every light. Like the other functions, it returns a number that depends on the results.
    float (*prepare)();
    /// Transforms every light to shading space and prepares it. Null for techniques without a competitor.
    float (*prepare_from_world)();
    /// Takes a sample of each prepared light. Each lane has a different light.
    float (*sample)();
    /// Like sample(), but without density and point. Null for techniques that have no such function.
    float (*direction)();
};

template <base::Isa>
std::vector<TimedTechnique> timed_techniques();

} // namespace nusselt::lab
