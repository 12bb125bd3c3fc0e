#pragma once
/// Exact sampling of bilinear interpolation in one texel.

#include <nusselt/emission/cell_descent.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// A density on [0, 1] that is linear from the lower edge of a texel to its centre, and from there to the upper edge:
/// the interpolation between the texel and its two neighbours.
/// \tparam Real float, double, long double or a pack of texels.
template <class Real>
struct TexelTent {
    Real before, middle, after; ///< at the centres of texels, not negative; not normalised

    /// The integral.
    NUSSELT_HD Real mean() const noexcept { return Real(0.125) * (before + after) + Real(0.75) * middle; }

    /// \param x in [0, 1].
    NUSSELT_HD Real value(const Real& x) const noexcept {
        const Real off_middle = abs(x - Real(0.5));
        return middle + off_middle * (select(x < Real(0.5), before, after) - middle);
    }

    /// \param u in [0, 1).
    NUSSELT_HD Real sample(Real u) const noexcept {
        const mask_t<Real> upper = choose_of_two(before + Real(3) * middle, Real(3) * middle + after, u);
        const Ends ends = ends_of(upper);
        const Real root = sqrt(ends.begin * ends.begin + u * (ends.end * ends.end - ends.begin * ends.begin));
        const Real sum = ends.begin + root;
        const Real share = select(sum > Real(0), u * (ends.begin + ends.end) / sum, u);
        return Real(0.5) * (select(upper, Real(1), Real(0)) + min(share, Real(1)));
    }

    /// What sample() undoes.
    NUSSELT_HD Real invert(const Real& x) const noexcept {
        const mask_t<Real> upper = x >= Real(0.5);
        const Ends ends = ends_of(upper);
        const Real share = Real(2) * x - select(upper, Real(1), Real(0));
        const Real sum = ends.begin + ends.end;
        const Real u =
            select(sum > Real(0), share * ((Real(2) - share) * ends.begin + share * ends.end) / sum, share);
        return unite_of_two(before + Real(3) * middle, Real(3) * middle + after, upper, u);
    }

private:
    struct Ends {
        Real begin, end;
    };
    /// Values at both ends of a half, of order one.
    NUSSELT_HD Ends ends_of(const mask_t<Real>& upper) const noexcept {
        const Real edge = Real(0.5) * (select(upper, after, before) + middle);
        const Real scale = reciprocal_power_of_two(max(edge, middle));
        return {scale * select(upper, middle, edge), scale * select(upper, edge, middle)};
    }
};

/// A texel and its eight neighbours.
template <class Real>
struct BilinearTexel {
    Real value[3][3]; ///< by row and column; the texel is in the middle

    /// Positions are relative to the texel, in [0, 1]^2.
    NUSSELT_HD Real at(const Vec2<Real>& x) const noexcept { return row_at(x.x).value(x.y); }
    NUSSELT_HD Real mean() const noexcept { return columns().mean(); }
    NUSSELT_HD Vec2<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real x = columns().sample(u.x);
        return {x, row_at(x).sample(u.y)};
    }
    NUSSELT_HD Vec2<Real> invert(const Vec2<Real>& x) const noexcept {
        return {columns().invert(x.x), row_at(x.x).invert(x.y)};
    }

private:
    /// The mean over the height of the texel.
    NUSSELT_HD TexelTent<Real> columns() const noexcept {
        const auto mean = [&](int i) {
            return TexelTent<Real>{value[0][i], value[1][i], value[2][i]}.mean();
        };
        return {mean(0), mean(1), mean(2)};
    }
    NUSSELT_HD TexelTent<Real> row_at(const Real& x) const noexcept {
        const auto row = [&](int j) {
            return TexelTent<Real>{value[j][0], value[j][1], value[j][2]}.value(x);
        };
        return {row(0), row(1), row(2)};
    }
};

} // namespace detail

NUSSELT_NAMESPACE_END
