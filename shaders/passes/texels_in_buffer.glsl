#ifndef NUSSELT_PASSES_TEXELS_IN_BUFFER_GLSL
#define NUSSELT_PASSES_TEXELS_IN_BUFFER_GLSL
/// Codes of texels in the same buffer as the values of textures: works on any device, up to the size limit of buffers.

#include "passes/scene.glsl"

uint code_at(const TextureRecord texture_record, uint index) {
    uint in_word = index & ((1u << texture_record.packing) - 1u);
    uint bits = 32u >> texture_record.packing;
    uint word = texture_words[texture_record.first_code + (index >> texture_record.packing)];
    return bitfieldExtract(word, int(in_word * bits), int(bits));
}

/// \param number of the texture
/// \returns for grey textures the code as x
uvec3 texel_codes(uint number, const TextureRecord texture_record, int column, int row) {
    uint texel = uint(row) * uint(texture_record.width) + uint(column);
    uint index = uint(texture_record.channels) * texel;
    uint red = code_at(texture_record, index);
    if (texture_record.channels == 1) return uvec3(red);
    return uvec3(red, code_at(texture_record, index + 1u), code_at(texture_record, index + 2u));
}

#endif
