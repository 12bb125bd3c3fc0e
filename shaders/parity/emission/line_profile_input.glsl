// Profiles of lines and tubes among the inputs, and what samples of these lights return.
#include "parity/words.glsl"

uint line_profile_word(uint at) { return word_at(at); }

// What the sample of a light returns besides the sample: the layout of nusselt::parity::EmissionOutputs.
struct AlongLine {
    float at, place;
    float unshadowed;
    float pdf;
    vec2 inverse;
    float measure;
};

void write_along(vec3 wi, float pdf, const AlongLine along) {
    write_vec3(0, wi);
    results[3] = pdf;
    results[4] = below_one(along.at);
    results[5] = 0.0;
    results[6] = along.place;
    results[7] = along.unshadowed;
    results[8] = along.pdf;
    results[9] = along.inverse.x;
    results[10] = along.inverse.y;
    results[11] = along.measure;
}
