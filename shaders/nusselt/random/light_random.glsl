#ifndef NUSSELT_RANDOM_LIGHT_RANDOM_GLSL
#define NUSSELT_RANDOM_LIGHT_RANDOM_GLSL
// Follows include/nusselt/random/light_random.h @ 121f95136e1e
/// The random numbers of a renderer of direct light as a pure function of seed, pixel, sample, light and dimension.
/// Twin of include/nusselt/random/light_random.h. The same bits as there.

#include "../random/blue_noise.glsl"
#include "../random/multi_jittered.glsl"
#include "../random/pcg.glsl"
#include "../random/sobol.glsl"
#include "../random/z_sobol.glsl"

// The patterns of the samples of one pixel and light, numbered as in `enum class Sampler`, which explains them.
const int kNusseltSamplerIndependent = 0;
const int kNusseltSamplerSobol = 1;
const int kNusseltSamplerJittered = 2;
const int kNusseltSamplerStratified = 3;
const int kNusseltSamplerZSobol = 4;
const int kNusseltSamplerBlueNoise = 5;

const uint kNusseltRandomOfCamera = 0u;
const uint kNusseltRandomOfLight = 1u;

/// A word for all that is the same in a whole image.
uint random_stream(uint seed, uint purpose, uint light, uint pair) {
    return pcg4d(uvec4(light, pair, purpose, seed)).x;
}

/// \param ranks of the pixel, for blue noise.
vec2 stream_random(int kind, uint stream, uint x, uint y, uint index, uint sample_count, uvec2 ranks) {
    if (kind == kNusseltSamplerIndependent) {
        uvec4 bits = pcg4d(uvec4(x, y, index, stream));
        return vec2(to_unit(bits.x), to_unit(bits.y));
    }
    if (kind == kNusseltSamplerZSobol) {
        PixelHierarchy hierarchy = make_pixel_hierarchy(sample_count);
        uvec4 tile = pcg4d(uvec4(x >> hierarchy.levels, y >> hierarchy.levels, 0u, stream));
        uvec2 bits = z_sobol(hierarchy, x, y, index, ZSobolSeeds(SobolSeeds(tile.z, tile.x, tile.y), tile.w));
        return vec2(to_unit(bits.x), to_unit(bits.y));
    }
    // The random bits that all samples of one pixel share.
    uvec4 key = pcg4d(uvec4(x, y, 0u, stream));
    if (kind == kNusseltSamplerBlueNoise) {
        key.x = blue_noise_bits(ranks.x, key.x);
        key.y = blue_noise_bits(ranks.y, key.y);
    }
    if (kind == kNusseltSamplerJittered || kind == kNusseltSamplerBlueNoise)
        return vec2(uniform_jittered(to_unit(key.x), index, sample_count), to_unit(reverse_bits(index) + key.y));
    if (kind == kNusseltSamplerStratified) {
        // The bits of one sample. The key differs from that of the pixel even for sample 0.
        uvec4 jitter = pcg4d(uvec4(x, y, index + 1u, stream));
        return multi_jittered(index, sample_count, MultiJitterKeys(key.x, key.y, key.z),
                              vec2(to_unit(jitter.x), to_unit(jitter.y)));
    }
    uvec2 bits = owen_scrambled_sobol(index, SobolSeeds(key.z, key.x, key.y));
    return vec2(to_unit(bits.x), to_unit(bits.y));
}

/// The indices of the ranks in the table of blue noise that light_random() needs. Parameters as there.
uvec2 light_blue_noise_indices(uint seed, uint x, uint y, uint light, uint pair) {
    // The key differs from those of pixels and, for less than 2^32 - 1 samples, of theirs.
    uint stream = random_stream(seed, kNusseltRandomOfLight, light, pair);
    return blue_noise_indices(pcg4d(uvec4(0u, 0u, 0xffffffffu, stream)), x, y);
}

/// Two numbers in [0, 1) to sample a light with; linear lights use x only.
/// \param kind         kNusseltSampler*.
/// \param seed         chooses one of 2^32 images.
/// \param x, y         the pixel.
/// \param index        of the sample, below sample_count; independent and Sobol' points have no use for sample_count.
/// \param sample_count samples per pixel and light, 1 to 2^22, or to 2^31 for kNusseltSamplerZSobol.
/// \param light        number of the light.
/// \param pair         number of the pair of dimensions, for techniques that need more than one.
/// \param ranks        blue_noise_rank() at light_blue_noise_indices(), for kNusseltSamplerBlueNoise; the others have no use
///                     for them.
vec2 light_random(int kind, uint seed, uint x, uint y, uint index, uint sample_count, uint light, uint pair, uvec2 ranks) {
    return stream_random(kind, random_stream(seed, kNusseltRandomOfLight, light, pair), x, y, index, sample_count, ranks);
}

/// The same for all samplers but kNusseltSamplerBlueNoise.
vec2 light_random(int kind, uint seed, uint x, uint y, uint index, uint sample_count, uint light, uint pair) {
    return light_random(kind, seed, x, y, index, sample_count, light, pair, uvec2(0u));
}

/// Two numbers in [0, 1): the position of a camera ray in its pixel. All samplers but independent ones use Sobol' points
/// here, with pixels independent of each other: camera rays want both dimensions stratified alike, and do not know their
/// number. Independent of all light_random(). Parameters as there.
vec2 camera_random(int kind, uint seed, uint x, uint y, uint index) {
    int camera_kind = kind == kNusseltSamplerIndependent ? kind : kNusseltSamplerSobol;
    return stream_random(camera_kind, random_stream(seed, kNusseltRandomOfCamera, 0u, 0u), x, y, index, 1u,
                         uvec2(0u));
}

#endif
