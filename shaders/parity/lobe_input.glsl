// The lobes of C++ among the inputs.
#include "parity/buffers.glsl"

const uint kLobeSize = 6u;

// An LtcCoefficients<float> of C++.
Ltc input_lobe(uint begin) {
    return ltc_prepare(LtcCoefficients(input_at(begin), input_at(begin + 1u), input_at(begin + 2u), input_at(begin + 3u),
                                       input_at(begin + 4u), input_at(begin + 5u)));
}
