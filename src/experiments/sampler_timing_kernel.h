#pragma once
/// What the units compiled per instruction set offer to sampler_timing.cpp: plain data and functions.

namespace nusselt::experiments {

inline constexpr int kTimedLights = 256;
inline constexpr int kLargestVertexCount = 8;

/// Lights in shading space and random numbers, one column per light. Polygons with fewer vertices repeat the
/// last one; lines have two.
struct TimedLights {
    float coordinates[kLargestVertexCount][3][kTimedLights];
    float u[2][kTimedLights];
};

enum class LightKind { polygon, line };

struct TimedTechnique {
    const char* name;
    LightKind kind;
    int lanes;
    int vertex_bound; ///< largest vertex count, 2 for lines
    void (*load)(
        const TimedLights&); ///< to be called first: converts the lights to the type of the technique
    /// One preparation and one sample per light. Returns a sum that depends on every result.
    float (*prepare)();
    /// One preparation, kTimedLights samples of the first light; likewise.
    float (*sample)();
};

struct TimedTechniques {
    const TimedTechnique* begin;
    int count;
};

TimedTechniques timed_techniques_sse42();
TimedTechniques timed_techniques_avx2();
TimedTechniques timed_techniques_avx512();

} // namespace nusselt::experiments
