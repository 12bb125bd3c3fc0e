#pragma once
/// Textures of radiance in the plane of a light, and how their texels become a function of the position.

#include <nusselt/core/light_sample.h>

NUSSELT_NAMESPACE_BEGIN

/// Radiance of a light as rows of texels. Texture coordinates (0, 0) and (1, 1) are the outer corners of the first and of
/// the last texel; texel (i, j) is at index j * width + i.
template <class T>
struct TextureView {
    const Vec3<T>* texel; ///< radiance per channel [W/(sr m^2)]: finite and not negative. The caller owns it.
    int width, height;    ///< at least 1
};

/// A sample on a light with a texture.
template <class Real>
struct TexturedSample : LightSample<Real> {
    /// Texture coordinates of p. Look up the radiance there: those of the rounded p may lie in another texel, for which the
    /// density is wrong.
    Vec2<Real> at;
};

/// The part that a texel takes of an interval of the texture.
template <class T>
struct TexelShares {
    static constexpr int kMost = 4;
    int first;      ///< texel
    int count;      ///< of texels, 1 to kMost
    T share[kMost]; ///< of texels first, first + 1, ...; they add up to 1
};

namespace detail {

/// floor() for numbers that fit.
template <class T>
NUSSELT_HD inline int floor_to_int(const T& x) noexcept {
    return static_cast<int>(floor(x));
}

NUSSELT_HD constexpr int clamp_index(int i, int size) noexcept { return i < 0 ? 0 : i < size ? i : size - 1; }

/// Shares of an interval from the integral of the basis function of a texel that is the same for all.
/// \param integral of the basis function of the texel with the centre 0, up to x.
/// \param reach    beyond which the basis function is zero.
template <class T, class Integral>
NUSSELT_HD inline TexelShares<T> shares_of(const T& begin, const T& end, int size, const T& reach,
                                           const Integral& integral) noexcept {
    constexpr int kMost = TexelShares<T>::kMost;
    const int lowest = floor_to_int(begin - reach + T(0.5));
    TexelShares<T> shares{clamp_index(lowest, size), 1, {}};
    for (int k = 0; k <= kMost; ++k) {
        const T centre = static_cast<T>(lowest + k) + T(0.5);
        const T share = (integral(end - centre) - integral(begin - centre)) / (end - begin);
        if (!(share > T(0))) continue;
        // Beyond the edge, the texel at the edge goes on.
        const int slot = clamp_index(clamp_index(lowest + k, size) - shares.first, kMost);
        shares.share[slot] = shares.share[slot] + share;
        shares.count = slot + 1 > shares.count ? slot + 1 : shares.count;
    }
    return shares;
}

} // namespace detail

/// Radiance is constant in each texel.
struct NearestFilter {
    /// \param begin, end an interval of no more than one texel, in texels.
    template <class T>
    NUSSELT_HD static TexelShares<T> shares(const T& begin, const T& end, int size) noexcept {
        return detail::shares_of(begin, end, size, T(0.5),
                                 [](const T& x) { return min(max(x, T(-0.5)), T(0.5)); });
    }

    /// Radiance at texture coordinates in [0, 1].
    template <class T>
    NUSSELT_HD static Vec3<T> lookup(const TextureView<T>& texture, const Vec2<T>& at) noexcept {
        const int i =
            detail::clamp_index(detail::floor_to_int(at.x * static_cast<T>(texture.width)), texture.width);
        const int j =
            detail::clamp_index(detail::floor_to_int(at.y * static_cast<T>(texture.height)), texture.height);
        return texture.texel[j * texture.width + i];
    }
};

/// Radiance is interpolated between the centres of texels, and constant beyond those at the edge. Its mean over a texel
/// has the weights 1/8, 6/8, 1/8 in both directions.
struct BilinearFilter {
    /// \copydoc NearestFilter::shares
    template <class T>
    NUSSELT_HD static TexelShares<T> shares(const T& begin, const T& end, int size) noexcept {
        return detail::shares_of(begin, end, size, T(1), [](const T& x) {
            const T rest = max(T(1) - abs(x), T(0));
            return copysign(T(0.5) * (T(1) - rest * rest), x);
        });
    }

    /// \copydoc NearestFilter::lookup
    template <class T>
    NUSSELT_HD static Vec3<T> lookup(const TextureView<T>& texture, const Vec2<T>& at) noexcept {
        const T x = at.x * static_cast<T>(texture.width) - T(0.5);
        const T y = at.y * static_cast<T>(texture.height) - T(0.5);
        const T begin_x = floor(x);
        const T begin_y = floor(y);
        const auto texel = [&](int i, int j) {
            return texture.texel[detail::clamp_index(j, texture.height) * texture.width +
                                 detail::clamp_index(i, texture.width)];
        };
        const int i = static_cast<int>(begin_x);
        const int j = static_cast<int>(begin_y);
        const T right = x - begin_x;
        const T up = y - begin_y;
        return (T(1) - up) * ((T(1) - right) * texel(i, j) + right * texel(i + 1, j)) +
               up * ((T(1) - right) * texel(i, j + 1) + right * texel(i + 1, j + 1));
    }
};

/// The scalar that probabilities go with. Luminance would give blue light 14 times too few samples.
template <class T>
NUSSELT_HD constexpr T mean_of_channels(const Vec3<T>& radiance) noexcept {
    return (radiance.x + radiance.y + radiance.z) / T(3);
}

/// Mean radiance over a rectangle of the texture, exact for the filter.
/// \param low, high texture coordinates; the rectangle is no larger than a texel.
template <class Filter, class T>
NUSSELT_HD inline Vec3<T> mean_radiance(const TextureView<T>& texture, const Vec2<T>& low,
                                        const Vec2<T>& high) noexcept {
    const auto width = static_cast<T>(texture.width);
    const auto height = static_cast<T>(texture.height);
    const TexelShares<T> across = Filter::shares(low.x * width, high.x * width, texture.width);
    const TexelShares<T> along = Filter::shares(low.y * height, high.y * height, texture.height);
    Vec3<T> sum{T(0), T(0), T(0)};
    for (int j = 0; j < along.count; ++j) {
        const Vec3<T>* row = texture.texel + (along.first + j) * texture.width + across.first;
        for (int i = 0; i < across.count; ++i) sum += (along.share[j] * across.share[i]) * row[i];
    }
    return sum;
}

NUSSELT_NAMESPACE_END
