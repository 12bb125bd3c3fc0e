// A mutant that the comparison must reject: it takes all lights for wholly visible ones, also those that the horizon cuts.
Technique uncut_prepare(const Ellipsoid light) {
    Technique technique = technique_prepare(light);
    technique.cone.is_whole = true;
    return technique;
}
#undef technique_prepare
#define technique_prepare uncut_prepare
#include "parity/ellipsoid.glsl"
