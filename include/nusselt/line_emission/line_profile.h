#pragma once
/// Radiance that varies along linear lights and tubes: interpolated linearly between the centres of texels.

#include <nusselt/emission/lane_index.h>
#include <nusselt/emission/texture.h>

NUSSELT_NAMESPACE_BEGIN

/// Radiance along a line, prepared once for all shading points.
/// \tparam n the largest number of texels.
template <class T, int n = 64>
struct LineProfile {
    static constexpr int kMostTexels = n;
    static constexpr int kSlots = (n + 1 + 7) / 8 * 8; ///< for cells, in whole registers

    int cells;                 ///< one more than there are texels
    T border[kSlots + 1];      ///< where cells begin, from 0 to 1; 1 for all further ones
    T value[kSlots + 1];       ///< radiance at borders, averaged over channels
    T radiance[3][kSlots + 1]; ///< the same per channel [W/(sr m^2)]
    T before[kSlots + 1];      ///< integral of the values from 0 to the border

    /// Radiance at a point, or at one per lane of a pack. \param x in [0, 1]
    template <class Real>
    NUSSELT_HD Vec3<Real> lookup(const Real& x) const noexcept {
        const Place<Real> at(*this, x);
        return {at.between(radiance[0]), at.between(radiance[1]), at.between(radiance[2])};
    }

    /// The cell at a point. \param x in [0, 1]
    template <class Real>
    NUSSELT_HD detail::index_t<Real> cell_at(const Real& x) const noexcept {
        return detail::index_below<Real>(x * Real(static_cast<T>(cells - 1)) + Real(T(0.5)), cells);
    }

    /// The integral of radiance, averaged over channels, from 0 to a point; that to 1 is the mean. \param x in [0, 1]
    NUSSELT_HD T below(const T& x) const noexcept {
        const int k = cell_at(x);
        const T width = border[k + 1] - border[k];
        const T share = (x - border[k]) / width;
        return before[k] + width * share * (value[k] + T(0.5) * share * (value[k + 1] - value[k]));
    }

private:
    /// Points in their cells.
    template <class Real>
    struct Place {
        detail::LanePlaces<Real> cell;
        Real share; ///< of the cell before the point

        NUSSELT_HD Place(const LineProfile& profile, const Real& x) noexcept
            : cell(detail::places<Real>(profile.cell_at(x), detail::index_t<Real>(0), 0)) {
            const Real low = cell.load(profile.border);
            share = (x - low) / (cell.load(profile.border + 1) - low);
        }
        NUSSELT_HD Real between(const T* values) const noexcept {
            return (Real(T(1)) - share) * cell.load(values) + share * cell.load(values + 1);
        }
    };
};

/// \param texel radiance of parts of the line of equal length, from its start to its end [W/(sr m^2)]: finite and not
///              negative. Radiance is interpolated between their middles and constant beyond the first and the last one.
/// \param count 1 to n.
template <int n = 64, class T>
NUSSELT_HD inline LineProfile<T, n> make_line_profile(const Vec3<T>* texel, int count) noexcept {
    LineProfile<T, n> profile{};
    profile.cells = count + 1;
    for (int k = 0; k <= profile.kSlots; ++k) {
        profile.border[k] = k == 0      ? T(0)
                            : k > count ? T(1)
                                        : (static_cast<T>(k) - T(0.5)) / static_cast<T>(count);
        const Vec3<T>& radiance = texel[detail::clamp_index(k - 1, count)];
        profile.radiance[0][k] = radiance.x;
        profile.radiance[1][k] = radiance.y;
        profile.radiance[2][k] = radiance.z;
        profile.value[k] = mean_of_channels(radiance);
        if (k > 0)
            profile.before[k] = profile.before[k - 1] + T(0.5) * (profile.border[k] - profile.border[k - 1]) *
                                                            (profile.value[k - 1] + profile.value[k]);
    }
    return profile;
}

NUSSELT_NAMESPACE_END
