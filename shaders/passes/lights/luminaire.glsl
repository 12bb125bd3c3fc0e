#ifndef NUSSELT_PASSES_LIGHTS_LUMINAIRE_GLSL
#define NUSSELT_PASSES_LIGHTS_LUMINAIRE_GLSL
/// Lookups of luminaires, as in src/render_cpu/kernel/lights/luminaire.h.

#include "interface/profiles.h"
#include "nusselt/core/trig.glsl"
#include "passes/lights/emission_words.glsl"

float emission_float(uint at) { return uintBitsToFloat(emission_words[at]); }
vec3 emission_vec3(uint at) { return vec3(emission_float(at), emission_float(at + 1u), emission_float(at + 2u)); }

/// The last of the increasing numbers but one that is not above a value; the first one if all are.
/// \param first word of the numbers
uint step_of(uint first, uint count, float value) {
    uint low = 0u;
    uint high = count - 1u;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (emission_float(first + middle) <= value)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/// The intensity in a direction of unit length, in the frame of the luminaire.
float intensity_in(uint luminaire, vec3 w) {
    uint verticals = emission_words[luminaire + kLuminaireVerticals];
    uint horizontals = emission_words[luminaire + kLuminaireHorizontals];
    uint v = luminaire + kLuminaireAngles;
    uint h = v + verticals;
    float vertical = atan2_positive(sqrt(w.x * w.x + w.y * w.y), w.z);
    // Comparisons with NaN are false.
    if (!(vertical >= emission_float(v) && vertical <= emission_float(v + verticals - 1u))) return 0.0;
    float half_turn = atan2_positive(abs(w.y), w.x);
    float horizontal = w.y > 0.0 ? 2.0 * kNusseltPi - half_turn : half_turn;
    if (horizontal < emission_float(h)) horizontal += 2.0 * kNusseltPi;
    uint i = step_of(v, verticals, vertical);
    uint j = step_of(h, horizontals, horizontal);
    v += i;
    h += j;
    float s = (vertical - emission_float(v)) / (emission_float(v + 1u) - emission_float(v));
    float t = nusselt_min((horizontal - emission_float(h)) / (emission_float(h + 1u) - emission_float(h)), 1.0);
    uint row = luminaire + kLuminaireAngles + verticals + horizontals + j * verticals + i;
    uint next = row + verticals;
    return (1.0 - t) * ((1.0 - s) * emission_float(row) + s * emission_float(row + 1u)) +
           t * ((1.0 - s) * emission_float(next) + s * emission_float(next + 1u));
}

#endif
