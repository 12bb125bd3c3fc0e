#include "parity/lobe_input.glsl"

// Inputs: a lobe and a unit vector.
void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint begin = (kLobeSize + 3u) * i;
    const Ltc ltc = input_lobe(begin);
    const vec3 v = input_vec3(begin + kLobeSize);
    const uint at = kOutputSize * i;
    write_vec3(at, ltc_to_cosine(ltc, v));
    write_vec3(at + 3u, ltc_to_shading(ltc, v));
    write_vec3(at + 6u, ltc_normal_to_cosine(ltc, v));
    outputs[at + 9u] = ltc.minor;
    outputs[at + 10u] = ltc_density(ltc, v);
    outputs[at + 11u] = radius_ratio(v, ltc);
}
