#pragma once
/// The interface of the units compiled per instruction set to emission_timing.cpp: plain data and functions.

#include "base/isa.h"

namespace nusselt::lab {

inline constexpr int kEmissionViews = 512;
inline constexpr int kEmissionSamples = 16;

/// Shading points: the frames of their surfaces and their places in the space of the unit square, where its corners are
/// (0, 0, 0), (1, 0, 0) and (0, 1, 0), and random numbers.
struct EmissionViews {
    float tangent[kEmissionViews][3], bitangent[kEmissionViews][3], normal[kEmissionViews][3];
    float position[kEmissionViews][3];
    float u[kEmissionViews][kEmissionSamples][2];
};

/// Functions that do something for all shading points. Their results have no meaning, but must be used.
struct EmissionTechnique {
    const char* name;
    float (*prepare)(const EmissionViews&);
    float (*sample_once)(const EmissionViews&);  ///< prepare and take one sample
    float (*sample_often)(const EmissionViews&); ///< prepare and take kEmissionSamples samples
    float (*ask_density)(const EmissionViews&);  ///< prepare and ask for the density in one direction
};

/// Techniques for lights of one shape in one type of numbers. The first one ignores how emission varies: costs of the others
/// are compared to its own.
struct EmissionGroup {
    const EmissionTechnique* first;
    int count;
};

struct EmissionGroups {
    const EmissionGroup* first;
    int count;
};

template <base::Isa>
EmissionGroups emission_groups();

} // namespace nusselt::lab
