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

/// The results of the last two have no meaning, but must be used.
struct RoundTechnique {
    const char* name;
    bool is_ours;
    bool is_by_solid_angle; ///< the usual one, with which others are compared
    /// The cosine over the density of each sample, 0 for those that miss the light.
    void (*weigh)(const RoundLights&, float (&weight)[kRoundLights][kRoundSamples]);
    float (*prepare)(const RoundLights&);
    float (*prepare_and_sample)(const RoundLights&); ///< kRoundSamples samples of each light
};

struct RoundTechniques {
    const RoundTechnique* first;
    int count;
};

RoundTechniques techniques_for_spheres();
RoundTechniques techniques_for_disks();

} // namespace nusselt::lab
