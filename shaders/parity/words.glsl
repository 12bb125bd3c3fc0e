// Words of tables or lights, which all lights or calls share.
#include "parity/buffers.glsl"

#ifdef GL_ES
uniform highp usampler2D words;
uint word_at(uint at) { return texel_at(words, at); }
#else
layout(set = 0, binding = 2, std430) readonly buffer Words { uint words[]; };
uint word_at(uint at) { return words[at]; }
#endif
