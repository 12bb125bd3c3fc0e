#pragma once
/// The interface of the units compiled per instruction set to sampler_timing.cpp: plain data and functions.

#include "base/isa.h"

#include <cstddef>

namespace nusselt::lab {

inline constexpr int kTimedLights = 256;
inline constexpr int kLargestVertexCount = 8;

/// Lights and random numbers, one column per light. Polygons with fewer vertices repeat the last one; lines and the axes
/// of cylinders have two vertices. Opposite ones of four vertices are the ends of two diameters of round lights.
struct TimedLights {
    float coordinates[kLargestVertexCount][3][kTimedLights]; ///< in shading space [m]
    float world[kLargestVertexCount][3][kTimedLights];       ///< of the same lights [m]
    float point[3][kTimedLights];                            ///< shading points [m]
    float normal[3][kTimedLights];                           ///< at the shading points
    float radius[kTimedLights];                              ///< of cylinders [m]
    float lobe[6][kTimedLights];                             ///< the members of LtcCoefficients in order
    float u[2][kTimedLights];
};

/// The names are those in techniques.json, except that round lights are all of spheres, disks, ellipses and ellipsoids.
enum class LightKind {
    polygon,
    polygon_on_lobe,
    line,
    line_on_lobe,
    cylinder,
    cylinder_on_lobe,
    round,
    round_on_lobe
};

constexpr bool is_polygon(LightKind kind) {
    return kind == LightKind::polygon || kind == LightKind::polygon_on_lobe;
}

constexpr bool is_cylinder(LightKind kind) {
    return kind == LightKind::cylinder || kind == LightKind::cylinder_on_lobe;
}

constexpr bool is_round(LightKind kind) {
    return kind == LightKind::round || kind == LightKind::round_on_lobe;
}

constexpr bool has_lobe(LightKind kind) {
    return kind == LightKind::polygon_on_lobe || kind == LightKind::line_on_lobe ||
           kind == LightKind::cylinder_on_lobe || kind == LightKind::round_on_lobe;
}

/// Groups of lights in the type that techniques take: as many in a group as a pack has lanes. All functions fill or read
/// arrays of kTimedLights / lanes elements with the given sizes, aligned to a cache line.
struct TimedLightType {
    std::size_t light_size, place_size, random_size; ///< of an element [bytes]
    void (*load)(const TimedLights&, void* lights);
    void (*load_random)(const TimedLights&, void* random);
    /// Also where lights in world space are seen from. Null for lights on lobes.
    void (*load_places)(const TimedLights&, void* places);
};

/// A technique as functions on memory. Each compiles on its own, so that a technique costs its compiler no more than it
/// must; the loops over lights are in sampler_loops.cpp. Calls cost the baseline the same.
struct TimedTechnique {
    const char* name;
    LightKind kind;
    int lanes;
    int vertex_count; ///< the bound on the number of vertices; 2 for lines and cylinders, 4 for round lights
    const TimedLightType* light_type;
    std::size_t size; ///< [bytes]
    /// Constructs the technique for a group of lights.
    void (*prepare)(const void* light, void* technique);
    /// Takes `count` samples, each with the next random number.
    void (*sample)(const void* technique, const void* random, int count);
    /// Like sample(), but without density and point. Null for techniques that have no such function.
    void (*direction)(const void* technique, const void* random, int count);
    /// Transforms a group of lights to shading space. Null for techniques without a competitor.
    void (*transform)(const void* place, void* light);
};

struct TimedTechniques {
    const TimedTechnique* begin;
    int count;
};

/// All techniques, polygons having four vertices. Baselines precede the techniques with the same kind of light, lanes and
/// number of vertices.
template <base::Isa>
TimedTechniques timed_techniques();

/// Techniques for polygons with 3, 5, 6 and 7 vertices. They need AVX2.
TimedTechniques timed_techniques_with_other_bounds();

} // namespace nusselt::lab
