#pragma once
/// The interface of the units compiled per instruction set to accuracy.cpp: plain data and functions.

#include "base/isa.h"

namespace nusselt::lab {

inline constexpr int kPackedLights = 256;

/// The numbers of many lights, with a column for each number in the order of declaration.
struct LightColumns {
    static constexpr int kLargest = 3 * (2 * 8 + 1) + 6; ///< an octagon on a lobe
    float light[kLargest][kPackedLights];
    float u[2][kPackedLights];
};

struct SampleColumns {
    float wi[3][kPackedLights];
    float pdf[kPackedLights];
    float measure[kPackedLights];
};

struct PackedTechnique {
    const char* name;
    int vertex_bound;                                 ///< 2 for lines and cylinders
    void (*run)(const LightColumns&, SampleColumns&); ///< prepares for each light and takes one sample
};

struct PackedTechniques {
    const PackedTechnique* begin;
    int count;
};

template <base::Isa>
PackedTechniques packed_techniques();

} // namespace nusselt::lab
