// The lobes of C++ among the inputs.
#include "parity/buffers.glsl"

const uint kLobeSize = 6u;

// An LtcCoefficients<float> of C++.
Ltc input_lobe(uint begin) {
    return ltc_prepare(LtcCoefficients(inputs[begin], inputs[begin + 1u], inputs[begin + 2u], inputs[begin + 3u],
                                       inputs[begin + 4u], inputs[begin + 5u]));
}
