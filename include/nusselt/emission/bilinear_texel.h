#pragma once
/// Exact sampling of bilinear interpolation in one texel.

#include <nusselt/emission/cell_descent.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// A density on [0, 1] that is linear from the lower edge of a texel to its centre, and from there to the upper edge:
/// the interpolation between the texel and its two neighbours.
template <class T>
struct TexelTent {
    T before, middle, after; ///< at the centres of texels, not negative; not normalised

    /// The integral.
    NUSSELT_HD T mean() const noexcept { return T(0.125) * (before + after) + T(0.75) * middle; }

    /// \param x in [0, 1].
    NUSSELT_HD T value(const T& x) const noexcept {
        const T off_middle = abs(x - T(0.5));
        return middle + off_middle * ((x < T(0.5) ? before : after) - middle);
    }

    /// \param u in [0, 1).
    NUSSELT_HD T sample(T u) const noexcept {
        const int half = choose_of_two(before + T(3) * middle, T(3) * middle + after, u);
        const Ends ends = ends_of(half);
        const T root = sqrt(ends.begin * ends.begin + u * (ends.end * ends.end - ends.begin * ends.begin));
        const T sum = ends.begin + root;
        const T share = sum > T(0) ? u * (ends.begin + ends.end) / sum : u;
        return T(0.5) * (static_cast<T>(half) + min(share, T(1)));
    }

    /// What sample() undoes.
    NUSSELT_HD T invert(const T& x) const noexcept {
        const int half = x < T(0.5) ? 0 : 1;
        const Ends ends = ends_of(half);
        const T share = T(2) * x - static_cast<T>(half);
        const T sum = ends.begin + ends.end;
        const T u = sum > T(0) ? share * ((T(2) - share) * ends.begin + share * ends.end) / sum : share;
        return unite_of_two(before + T(3) * middle, T(3) * middle + after, half, u);
    }

private:
    struct Ends {
        T begin, end;
    };
    /// Values at both ends of a half, of order one.
    NUSSELT_HD Ends ends_of(int half) const noexcept {
        const T edge = T(0.5) * ((half == 0 ? before : after) + middle);
        const T scale = reciprocal_power_of_two(max(edge, middle));
        return half == 0 ? Ends{scale * edge, scale * middle} : Ends{scale * middle, scale * edge};
    }
};

/// A texel and its eight neighbours.
template <class T>
struct BilinearTexel {
    T value[3][3]; ///< by row and column; the texel is in the middle

    /// Positions are relative to the texel, in [0, 1]^2.
    NUSSELT_HD T at(const Vec2<T>& x) const noexcept { return row_at(x.x).value(x.y); }
    NUSSELT_HD T mean() const noexcept { return columns().mean(); }
    NUSSELT_HD Vec2<T> sample(const Vec2<T>& u) const noexcept {
        const T x = columns().sample(u.x);
        return {x, row_at(x).sample(u.y)};
    }
    NUSSELT_HD Vec2<T> invert(const Vec2<T>& x) const noexcept {
        return {columns().invert(x.x), row_at(x.x).invert(x.y)};
    }

private:
    /// The mean over the height of the texel.
    NUSSELT_HD TexelTent<T> columns() const noexcept {
        const auto mean = [&](int i) { return TexelTent<T>{value[0][i], value[1][i], value[2][i]}.mean(); };
        return {mean(0), mean(1), mean(2)};
    }
    NUSSELT_HD TexelTent<T> row_at(const T& x) const noexcept {
        const auto row = [&](int j) { return TexelTent<T>{value[j][0], value[j][1], value[j][2]}.value(x); };
        return {row(0), row(1), row(2)};
    }
};

} // namespace detail

NUSSELT_NAMESPACE_END
