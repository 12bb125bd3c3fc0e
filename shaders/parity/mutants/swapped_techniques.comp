#version 450
#extension GL_GOOGLE_include_directive : require
// A mutant that the comparison must reject: it takes the sample for one of the other technique.
#include "nusselt/estimate/mis.glsl"

MisEstimate swapped_mis_estimate(int heuristic, int drawn, float visibility, const MisTechniques techniques,
                                 const MisSample at) {
    return mis_estimate(heuristic, 1 - drawn, visibility, techniques, at);
}
#define mis_estimate swapped_mis_estimate
#include "parity/functions/mis.glsl"
