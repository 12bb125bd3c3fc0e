#ifndef NUSSELT_PASSES_TEXTURE_GLSL
#define NUSSELT_PASSES_TEXTURE_GLSL
/// Texture lookups. The weights of samplers have eight bits only, so this code filters: images must agree with those of the
/// CPU (src/render_cpu/kernel/texture.h).

#ifndef TEXTURE_IMAGES
#error TEXTURE_IMAGES must be 1 where the device indexes images in shaders, else 0
#endif

#include "nusselt/core/real.glsl"
#include "passes/scene.glsl"
#if TEXTURE_IMAGES
#include "passes/texels_in_images.glsl"
#else
#include "passes/texels_in_buffer.glsl"
#endif

/// The two texels next to a texture coordinate along one axis.
struct TexelPair {
    int first, second;
    float weight;   ///< of the second
    float coverage; ///< fraction of both that lies within the texture
};

TexelPair texel_pair(float coordinate, int size, const TextureRecord texture_record) {
    float count = float(size);
    float last = count - 1.0;
    // Coordinates that overflowed in the scene file or in interpolation count as 0.
    float sound = is_finite(coordinate) ? coordinate : 0.0;
    bool repeats = texture_record.wrap == kWrapRepeat;
    precise float scaled = (repeats ? sound - floor(sound) : sound) * count;
    // Textures that do not repeat are constant from one texel outside on.
    precise float position = texture_record.is_nearest != 0u ? floor(scaled) : scaled - 0.5;
    position = max(min(position, count + 1.0), -2.0);
    float below = floor(position);
    float next = below + 1.0;
    float first = repeats && below < 0.0 ? last : below;
    float second = repeats && next >= count ? 0.0 : next;
    return TexelPair(int(max(min(first, last), 0.0)), int(max(min(second, last), 0.0)), position - below,
                     max(min(min(position + 1.0, count - position), 1.0), 0.0));
}

/// One channel of a texel.
float decoded(const TextureRecord texture_record, uint code) {
    return uintBitsToFloat(texture_record.packing == 0u ? code : texture_words[texture_record.first_value + code]);
}

vec3 texel_at(uint number, const TextureRecord texture_record, int column, int row) {
    uvec3 codes = texel_codes(number, texture_record, column, row);
    float red = decoded(texture_record, codes.x);
    if (texture_record.channels == 1) return vec3(red);
    return vec3(red, decoded(texture_record, codes.y), decoded(texture_record, codes.z));
}

/// \param uv see lookup_place()
vec3 look_up_texture(uint number, vec2 uv) {
    TextureRecord texture_record = textures[number];
    TexelPair x = texel_pair(uv.x, texture_record.width, texture_record);
    TexelPair y = texel_pair(uv.y, texture_record.height, texture_record);
    vec3 bottom_left = texel_at(number, texture_record, x.first, y.first);
    vec3 bottom = bottom_left + x.weight * (texel_at(number, texture_record, x.second, y.first) - bottom_left);
    vec3 top_left = texel_at(number, texture_record, x.first, y.second);
    vec3 top = top_left + x.weight * (texel_at(number, texture_record, x.second, y.second) - top_left);
    vec3 value = bottom + y.weight * (top - bottom);
    return texture_record.wrap == kWrapBlack ? (x.coverage * y.coverage) * value : value;
}

/// The place at which a surface with these texture coordinates looks up a texture.
vec2 lookup_place(const TextureLookup lookup, vec2 uv) {
    return vec2(lookup.scale[0] * uv.x + lookup.offset[0], lookup.scale[1] * uv.y + lookup.offset[1]);
}

/// The derivatives of a height by the two texture coordinates, as differences over one texel: those are continuous, while
/// the derivatives of bilinear textures jump.
vec2 height_derivatives(uint number, vec2 uv) {
    vec2 size = vec2(float(textures[number].width), float(textures[number].height));
    vec2 half_texel = vec2(0.5) / size;
    vec2 x = vec2(half_texel.x, 0.0);
    vec2 y = vec2(0.0, half_texel.y);
    return size * vec2(look_up_texture(number, uv + x).x - look_up_texture(number, uv - x).x,
                       look_up_texture(number, uv + y).x - look_up_texture(number, uv - y).x);
}

/// The probability that a ray meets a surface.
float alpha_of(const MaterialRecord material, vec2 uv) {
    if ((kTextureKinds & material.texture_kinds & kAlphaTexture) == 0u) return material.alpha;
    vec2 at = lookup_place(material.alpha_texture, uv);
    return material.alpha * look_up_texture(material.alpha_texture.texture, at).x;
}

#endif
