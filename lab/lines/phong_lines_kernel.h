#pragma once
/// The interface of the units compiled per instruction set to phong_lines.cpp: plain data and functions.

#include "base/isa.h"

namespace nusselt::lab {

inline constexpr int kPhongLines = 256;

/// Linear lights in shading space and mirrored directions, one column per light.
struct PhongLines {
    float p0[3][kPhongLines], s[3][kPhongLines], length[kPhongLines], mirror[3][kPhongLines];
};

/// Integrals of Phong lobes over all lines, one after the other, in float.
struct PhongEvaluation {
    int lanes; ///< of packed_quadrature
    void (*packed_quadrature)(const PhongLines&, int exponent, float* result);
    void (*quadrature)(const PhongLines&, int exponent, float* result);
    void (*recursion)(const PhongLines&, int exponent, float* result);
    void (*tabulate)(int exponent);
    void (*table)(const PhongLines&, int exponent, float* result); ///< tabulate() comes first
};

template <base::Isa>
PhongEvaluation phong_evaluation();

} // namespace nusselt::lab
