#pragma once
/// The random numbers of a renderer of direct light as a pure function of seed, pixel, sample, light and
/// dimension: nothing depends on scheduling.
///
/// The functions ending in _lanes give the same bits for all lanes of a pack. They consist of short loops
/// over 32-bit integers that compilers turn into vector code, which they do not for loops around the
/// functions for one sample: these branch on the sampler and are too long to be inlined.

#include <cstdint>

#include <nusselt/core/vec.h>
#include <nusselt/random/blue_noise.h>
#include <nusselt/random/multi_jittered.h>
#include <nusselt/random/pcg.h>
#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>
#include <nusselt/random/z_sobol.h>

NUSSELT_NAMESPACE_BEGIN

/// The pattern of the samples of one pixel and light. Lights and pairs of dimensions are independent of each other in every
/// case, and so are pixels unless the pattern says otherwise.
enum class Sampler {
    /// Samples are independent of each other.
    independent,
    /// Owen-scrambled Sobol' points: stratified in x, in y and in two dimensions, best for powers of two.
    sobol,
    /// Uniform jittered: x of sample k is (xi + k) / n with one xi, the choice for linear lights
    /// (Ramamoorthi, Anderson, Meyer, Nowrouzezahrai 2012, A Theory of Monte Carlo Visibility Sampling). For
    /// polygonal lights, y is the bit-reversed k with one random shift: a Hammersley point set, the same up
    /// to shifts everywhere.
    jittered,
    /// Multi-jittered: for any n, one sample in each n-th of x and of y, at random in it, and one in each cell of a grid
    /// that is as close to a square as n allows. Unlike with jittered ones, samples in different strata are independent.
    stratified,
    /// Sobol' points in the order of z_sobol.h: neighbouring pixels have the points that others leave out, so that errors
    /// cancel in squares of pixels. In each pixel, powers of two of points are as even as those of sobol.
    z_sobol,
    /// As jittered, but xi and the shift are blue noise over the pixels (blue_noise.h), best for linear lights.
    blue_noise,
};

namespace detail {

enum class RandomPurpose : std::uint32_t { camera, light };

/// A word for all that is the same in a whole image.
NUSSELT_HD constexpr std::uint32_t random_stream(std::uint32_t seed, RandomPurpose purpose,
                                                 std::uint32_t light, std::uint32_t pair) noexcept {
    return pcg4d({light, pair, static_cast<std::uint32_t>(purpose), seed}).x;
}

/// The random bits that all samples of one pixel share.
NUSSELT_HD constexpr UInt4 pixel_key(std::uint32_t x, std::uint32_t y, std::uint32_t stream) noexcept {
    return pcg4d({x, y, 0, stream});
}

/// The bits of one sample of a pixel. The key differs from pixel_key() even for sample 0.
NUSSELT_HD constexpr UInt4 jitter_bits(std::uint32_t x, std::uint32_t y, std::uint32_t sample,
                                       std::uint32_t stream) noexcept {
    return pcg4d({x, y, sample + 1, stream});
}

/// The second coordinate of jittered points. Unsigned addition wraps around like a shift on the unit
/// interval.
NUSSELT_HD constexpr std::uint32_t shifted_bit_reversal(std::uint32_t sample, std::uint32_t shift) noexcept {
    return reverse_bits(sample) + shift;
}

/// The shift of blue noise. The key differs from those of pixels and, for less than 2^32 - 1 samples, of theirs.
NUSSELT_HD constexpr BlueNoiseShift blue_noise_shift(std::uint32_t stream) noexcept {
    return BlueNoiseShift(pcg4d({0, 0, 0xffffffffu, stream}));
}

/// What z_sobol() takes from the key of a tile.
NUSSELT_HD constexpr ZSobolSeeds z_sobol_seeds(const UInt4& key) noexcept {
    return {{key.z, key.x, key.y}, key.w};
}

template <class Scalar>
NUSSELT_HD constexpr Vec2<Scalar>
stream_random(Sampler kind, std::uint32_t stream, std::uint32_t x, std::uint32_t y, std::uint32_t sample,
              std::uint32_t sample_count, BlueNoiseView blue_noise) noexcept {
    if (kind == Sampler::independent) {
        const UInt4 bits = pcg4d({x, y, sample, stream});
        return {to_unit<Scalar>(bits.x), to_unit<Scalar>(bits.y)};
    }
    if (kind == Sampler::z_sobol) {
        const PixelHierarchy hierarchy(sample_count);
        const UInt4 key = pixel_key(x >> hierarchy.levels, y >> hierarchy.levels, stream);
        const UInt2 bits = z_sobol(hierarchy, x, y, sample, z_sobol_seeds(key));
        return {to_unit<Scalar>(bits.x), to_unit<Scalar>(bits.y)};
    }
    UInt4 key = pixel_key(x, y, stream);
    if (kind == Sampler::blue_noise) {
        const BlueNoiseShift shift = blue_noise_shift(stream);
        key.x = blue_noise_bits(blue_noise.rank(shift.x.index(x, y)), key.x);
        key.y = blue_noise_bits(blue_noise.rank(shift.y.index(x, y)), key.y);
    }
    if (kind == Sampler::jittered || kind == Sampler::blue_noise) {
        return {uniform_jittered(to_unit<Scalar>(key.x), sample, sample_count),
                to_unit<Scalar>(shifted_bit_reversal(sample, key.y))};
    }
    if (kind == Sampler::stratified) {
        const UInt4 jitter = jitter_bits(x, y, sample, stream);
        return multi_jittered(sample, sample_count, {key.x, key.y, key.z}, to_unit<Scalar>(jitter.x),
                              to_unit<Scalar>(jitter.y));
    }
    const UInt2 bits = owen_scrambled_sobol(sample, {key.z, key.x, key.y});
    return {to_unit<Scalar>(bits.x), to_unit<Scalar>(bits.y)};
}

/// Sobol' points of each lane.
template <class Scalar, int N>
NUSSELT_HD void sobol_lanes(const std::uint32_t (&index)[N], const std::uint32_t (&key_x)[N],
                            const std::uint32_t (&key_y)[N], const std::uint32_t (&key_z)[N],
                            Scalar (&u_x)[N], Scalar (&u_y)[N]) noexcept {
    std::uint32_t shuffled[N];
    for (int i = 0; i < N; ++i) shuffled[i] = owen_scramble(index[i], key_z[i]);
    for (int i = 0; i < N; ++i) u_x[i] = to_unit<Scalar>(scrambled_sobol_x(shuffled[i], key_x[i]));
    for (int i = 0; i < N; ++i) u_y[i] = to_unit<Scalar>(scrambled_sobol_y(shuffled[i], key_y[i]));
}

template <class Scalar, int N>
NUSSELT_HD void z_sobol_lanes(std::uint32_t stream, const std::uint32_t (&x)[N], const std::uint32_t (&y)[N],
                              const std::uint32_t (&sample)[N], std::uint32_t sample_count, Scalar (&u_x)[N],
                              Scalar (&u_y)[N]) noexcept {
    const PixelHierarchy hierarchy(sample_count);
    std::uint32_t key_x[N], key_y[N], key_z[N], key_w[N];
    for (int i = 0; i < N; ++i) {
        const UInt4 key = pixel_key(x[i] >> hierarchy.levels, y[i] >> hierarchy.levels, stream);
        key_x[i] = key.x;
        key_y[i] = key.y;
        key_z[i] = key.z;
        key_w[i] = key.w;
    }
    std::uint32_t number[N], index[N] = {};
    for (int i = 0; i < N; ++i) number[i] = hierarchy.number(x[i], y[i]);
    for (std::uint32_t level = hierarchy.levels; level-- > 0;)
        for (int i = 0; i < N; ++i) index[i] = 4 * index[i] + hierarchy.digit(number[i], level, key_w[i]);
    for (int i = 0; i < N; ++i) index[i] = hierarchy.index(index[i], sample[i]);
    sobol_lanes(index, key_x, key_y, key_z, u_x, u_y);
}

template <class Scalar, int N>
NUSSELT_HD void stream_random_lanes(Sampler kind, std::uint32_t stream, const std::uint32_t (&x)[N],
                                    const std::uint32_t (&y)[N], const std::uint32_t (&sample)[N],
                                    std::uint32_t sample_count, BlueNoiseView blue_noise, Scalar (&u_x)[N],
                                    Scalar (&u_y)[N]) noexcept {
    if (kind == Sampler::independent) {
        for (int i = 0; i < N; ++i) {
            const UInt4 bits = pcg4d({x[i], y[i], sample[i], stream});
            u_x[i] = to_unit<Scalar>(bits.x);
            u_y[i] = to_unit<Scalar>(bits.y);
        }
        return;
    }
    if (kind == Sampler::z_sobol) return z_sobol_lanes(stream, x, y, sample, sample_count, u_x, u_y);
    std::uint32_t key_x[N], key_y[N], key_z[N];
    for (int i = 0; i < N; ++i) {
        const UInt4 key = pixel_key(x[i], y[i], stream);
        key_x[i] = key.x;
        key_y[i] = key.y;
        key_z[i] = key.z;
    }
    if (kind == Sampler::blue_noise) {
        const BlueNoiseShift shift = blue_noise_shift(stream);
        for (int i = 0; i < N; ++i) {
            key_x[i] = blue_noise_bits(blue_noise.rank(shift.x.index(x[i], y[i])), key_x[i]);
            key_y[i] = blue_noise_bits(blue_noise.rank(shift.y.index(x[i], y[i])), key_y[i]);
        }
    }
    if (kind == Sampler::jittered || kind == Sampler::blue_noise) {
        for (int i = 0; i < N; ++i) {
            u_x[i] = uniform_jittered(to_unit<Scalar>(key_x[i]), sample[i], sample_count);
            u_y[i] = to_unit<Scalar>(shifted_bit_reversal(sample[i], key_y[i]));
        }
        return;
    }
    if (kind == Sampler::stratified) {
        for (int i = 0; i < N; ++i) {
            const UInt4 jitter = jitter_bits(x[i], y[i], sample[i], stream);
            u_x[i] = to_unit<Scalar>(jitter.x);
            u_y[i] = to_unit<Scalar>(jitter.y);
        }
        MultiJitter(sample_count).points(sample, key_x, key_y, key_z, u_x, u_y);
        return;
    }
    sobol_lanes(sample, key_x, key_y, key_z, u_x, u_y);
}

/// Camera rays need both dimensions stratified alike, and their number is unknown.
NUSSELT_HD constexpr Sampler camera_sampler(Sampler kind) noexcept {
    return kind == Sampler::independent ? kind : Sampler::sobol;
}

} // namespace detail

/// Two numbers in [0, 1) to sample a light with; linear lights use x only.
/// \tparam Scalar      float (24 random bits), double or long double (32 bits).
/// \param seed         chooses one of 2^32 images.
/// \param x, y         the pixel.
/// \param sample       below sample_count; Sampler::independent and sobol have no use for sample_count.
/// \param sample_count samples per pixel and light, 1 to 2^22, or to 2^31 for Sampler::z_sobol.
/// \param light        number of the light.
/// \param pair         number of the pair of dimensions, for techniques that need more than one.
/// \param blue_noise   for Sampler::blue_noise; the others have no use for it.
template <class Scalar = float>
NUSSELT_HD constexpr Vec2<Scalar>
light_random(Sampler kind, std::uint32_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample,
             std::uint32_t sample_count, std::uint32_t light, std::uint32_t pair = 0,
             BlueNoiseView blue_noise = {}) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::light, light, pair);
    return detail::stream_random<Scalar>(kind, stream, x, y, sample, sample_count, blue_noise);
}

/// light_random() for one light, with a pixel and a sample per lane: lane i gets (u_x[i], u_y[i]).
template <class Scalar, int N>
NUSSELT_HD void light_random_lanes(Sampler kind, std::uint32_t seed, const std::uint32_t (&x)[N],
                                   const std::uint32_t (&y)[N], const std::uint32_t (&sample)[N],
                                   std::uint32_t sample_count, std::uint32_t light, std::uint32_t pair,
                                   Scalar (&u_x)[N], Scalar (&u_y)[N],
                                   BlueNoiseView blue_noise = {}) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::light, light, pair);
    detail::stream_random_lanes(kind, stream, x, y, sample, sample_count, blue_noise, u_x, u_y);
}

/// Two numbers in [0, 1): the position of a camera ray in its pixel. All samplers but Sampler::independent use
/// Sobol' points here, with pixels independent of each other. Independent of all light_random(). Parameters as there.
template <class Scalar = float>
NUSSELT_HD constexpr Vec2<Scalar> camera_random(Sampler kind, std::uint32_t seed, std::uint32_t x,
                                                std::uint32_t y, std::uint32_t sample) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::camera, 0, 0);
    return detail::stream_random<Scalar>(detail::camera_sampler(kind), stream, x, y, sample, 1, {});
}

/// camera_random() with a pixel and a sample per lane.
template <class Scalar, int N>
NUSSELT_HD void camera_random_lanes(Sampler kind, std::uint32_t seed, const std::uint32_t (&x)[N],
                                    const std::uint32_t (&y)[N], const std::uint32_t (&sample)[N],
                                    Scalar (&u_x)[N], Scalar (&u_y)[N]) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::camera, 0, 0);
    detail::stream_random_lanes(detail::camera_sampler(kind), stream, x, y, sample, 1, {}, u_x, u_y);
}

NUSSELT_NAMESPACE_END
