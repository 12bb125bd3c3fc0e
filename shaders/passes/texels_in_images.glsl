#ifndef NUSSELT_PASSES_TEXELS_IN_IMAGES_GLSL
#define NUSSELT_PASSES_TEXELS_IN_IMAGES_GLSL
/// Codes of texels in one image for each texture, on devices whose shaders can index images.

#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require

#include "passes/scene.glsl"

layout(set = 1, binding = 0) uniform utexture2D texture_images[];

/// \copydoc texel_codes of texels_in_buffer.glsl.
uvec3 texel_codes(uint number, const TextureRecord texture_record, int column, int row) {
    return texelFetch(texture_images[nonuniformEXT(number)], ivec2(column, row), 0).xyz;
}

#endif
