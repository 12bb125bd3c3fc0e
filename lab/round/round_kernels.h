#pragma once
/// The interface of the unit compiled for AVX2 to round_comparison.cpp: plain data and functions.

namespace nusselt::lab {

inline constexpr int kRoundLights = 256;
inline constexpr int kRoundSamples = 64; ///< a square number

/// Spheres or disks in shading space.
struct RoundLights {
    float center[kRoundLights][3];
    float normal[kRoundLights][3]; ///< of disks
    float radius[kRoundLights];
    float u[kRoundLights][kRoundSamples][2];
};

struct RoundWeights {
    float of[kRoundLights][kRoundSamples];
};

/// Who made a technique. The usual one is by solid angle; others are compared with it.
enum class RoundOrigin { ours, usual, other };

struct RoundTechnique {
    const char* name;
    RoundOrigin origin;
    /// The cosine over the density of each sample, 0 for those that miss the light.
    void (*weigh)(const RoundLights&, RoundWeights&);
    /// Prepares each light so many times.
    void (*prepare)(const RoundLights&, int times);
    /// Prepares each light and takes kRoundSamples samples of it, so many times.
    void (*prepare_and_sample)(const RoundLights&, int times);
};

struct RoundTechniques {
    const RoundTechnique* first;
    int count;
};

RoundTechniques techniques_for_spheres();
RoundTechniques techniques_for_disks();

} // namespace nusselt::lab
