#include "parity/lobe_input.glsl"

// Inputs: a lobe and a unit vector.
void compute(uint i) {
    uint begin = (kLobeSize + 3u) * i;
    Ltc ltc = input_lobe(begin);
    vec3 v = input_vec3(begin + kLobeSize);
    write_vec3(0, ltc_to_cosine(ltc, v));
    write_vec3(3, ltc_to_shading(ltc, v));
    write_vec3(6, ltc_normal_to_cosine(ltc, v));
    results[9] = ltc.minor;
    results[10] = ltc_density(ltc, v);
    results[11] = radius_ratio(v, ltc);
}
