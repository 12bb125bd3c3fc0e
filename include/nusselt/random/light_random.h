#pragma once
/// The random numbers of a renderer of direct light as a pure function of seed, pixel, sample, light and
/// dimension: nothing depends on scheduling.
///
/// The functions ending in _lanes give the same bits for all lanes of a pack. They consist of short loops
/// over 32-bit integers that compilers turn into vector code, which they do not for loops around the
/// functions for one sample: these branch on the sampler and are too long to be inlined.

#include <cstdint>

#include <nusselt/core/vec.h>
#include <nusselt/random/multi_jittered.h>
#include <nusselt/random/pcg.h>
#include <nusselt/random/sobol.h>
#include <nusselt/random/unit_interval.h>

NUSSELT_NAMESPACE_BEGIN

/// The pattern of the samples of one pixel and light. Pixels, lights and pairs of dimensions are
/// independent of each other in every case.
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

template <class Scalar>
NUSSELT_HD constexpr Vec2<Scalar> stream_random(Sampler kind, std::uint32_t stream, std::uint32_t x,
                                                std::uint32_t y, std::uint32_t sample,
                                                std::uint32_t sample_count) noexcept {
    if (kind == Sampler::independent) {
        const UInt4 bits = pcg4d({x, y, sample, stream});
        return {to_unit<Scalar>(bits.x), to_unit<Scalar>(bits.y)};
    }
    const UInt4 key = pixel_key(x, y, stream);
    if (kind == Sampler::jittered) {
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

template <class Scalar, int N>
NUSSELT_HD void stream_random_lanes(Sampler kind, std::uint32_t stream, const std::uint32_t (&x)[N],
                                    const std::uint32_t (&y)[N], const std::uint32_t (&sample)[N],
                                    std::uint32_t sample_count, Scalar (&u_x)[N], Scalar (&u_y)[N]) noexcept {
    if (kind == Sampler::independent) {
        for (int i = 0; i < N; ++i) {
            const UInt4 bits = pcg4d({x[i], y[i], sample[i], stream});
            u_x[i] = to_unit<Scalar>(bits.x);
            u_y[i] = to_unit<Scalar>(bits.y);
        }
        return;
    }
    std::uint32_t key_x[N], key_y[N], key_z[N];
    for (int i = 0; i < N; ++i) {
        const UInt4 key = pixel_key(x[i], y[i], stream);
        key_x[i] = key.x;
        key_y[i] = key.y;
        key_z[i] = key.z;
    }
    if (kind == Sampler::jittered) {
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
    std::uint32_t index[N];
    for (int i = 0; i < N; ++i) index[i] = owen_scramble(sample[i], key_z[i]);
    for (int i = 0; i < N; ++i) u_x[i] = to_unit<Scalar>(scrambled_sobol_x(index[i], key_x[i]));
    for (int i = 0; i < N; ++i) u_y[i] = to_unit<Scalar>(scrambled_sobol_y(index[i], key_y[i]));
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
/// \param sample       below sample_count for Sampler::jittered and stratified; the others have no use for sample_count.
/// \param sample_count samples per pixel and light, 1 to 2^22.
/// \param light        number of the light.
/// \param pair         number of the pair of dimensions, for techniques that need more than one.
template <class Scalar = float>
NUSSELT_HD constexpr Vec2<Scalar>
light_random(Sampler kind, std::uint32_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample,
             std::uint32_t sample_count, std::uint32_t light, std::uint32_t pair = 0) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::light, light, pair);
    return detail::stream_random<Scalar>(kind, stream, x, y, sample, sample_count);
}

/// light_random() for one light, with a pixel and a sample per lane: lane i gets (u_x[i], u_y[i]).
template <class Scalar, int N>
NUSSELT_HD void light_random_lanes(Sampler kind, std::uint32_t seed, const std::uint32_t (&x)[N],
                                   const std::uint32_t (&y)[N], const std::uint32_t (&sample)[N],
                                   std::uint32_t sample_count, std::uint32_t light, std::uint32_t pair,
                                   Scalar (&u_x)[N], Scalar (&u_y)[N]) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::light, light, pair);
    detail::stream_random_lanes(kind, stream, x, y, sample, sample_count, u_x, u_y);
}

/// Two numbers in [0, 1): the position of a camera ray in its pixel. Sampler::jittered and stratified use
/// Sobol' points here. Independent of all light_random(). Parameters as there.
template <class Scalar = float>
NUSSELT_HD constexpr Vec2<Scalar> camera_random(Sampler kind, std::uint32_t seed, std::uint32_t x,
                                                std::uint32_t y, std::uint32_t sample) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::camera, 0, 0);
    return detail::stream_random<Scalar>(detail::camera_sampler(kind), stream, x, y, sample, 1);
}

/// camera_random() with a pixel and a sample per lane.
template <class Scalar, int N>
NUSSELT_HD void camera_random_lanes(Sampler kind, std::uint32_t seed, const std::uint32_t (&x)[N],
                                    const std::uint32_t (&y)[N], const std::uint32_t (&sample)[N],
                                    Scalar (&u_x)[N], Scalar (&u_y)[N]) noexcept {
    const std::uint32_t stream = detail::random_stream(seed, detail::RandomPurpose::camera, 0, 0);
    detail::stream_random_lanes(detail::camera_sampler(kind), stream, x, y, sample, 1, u_x, u_y);
}

NUSSELT_NAMESPACE_END
