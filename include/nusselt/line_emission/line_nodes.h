#pragma once
/// Radiance of a linear light that depends on the direction, as one shading point sees it along the light: for TexturedLine.

#include <nusselt/core/trig.h>
#include <nusselt/geometry/line_segment.h>
#include <nusselt/line_emission/line_profile.h>

NUSSELT_NAMESPACE_BEGIN

/// Radiance at nodes along a line, and interpolated linearly between them. From the shading point, all cells have the same angle,
/// so that a profile is resolved alike near and far; they have the same length where this would give cells without length.
/// \tparam n the number of cells.
template <class T, int n = 32>
struct LineNodes {
    static constexpr int kSlots = (n + 7) / 8 * 8; ///< for cells, in whole registers
    static constexpr int cells = n;

    T border[kSlots + 1]; ///< where cells begin, from 0 to 1; 1 for all further ones
    T value[kSlots +
            1]; ///< radiance at borders, averaged over channels, and a little more: see make_line_nodes()
    T radiance[3][kSlots + 1]; ///< the same per channel, without more [W/(sr m^2)]

    /// The cell at a point. \param x in [0, 1]
    NUSSELT_HD int cell_at(const T& x) const noexcept {
        int low = 0;
        int high = n;
        while (high - low > 1) {
            const int middle = (low + high) / 2;
            if (border[middle] <= x)
                low = middle;
            else
                high = middle;
        }
        return low;
    }
};

/// A narrow beam may pass between the nodes. Thus values are never below this share of the largest one, or of `typical`.
inline constexpr double kLeastNodeShare = 0.01;

/// \param light    in shading space [m].
/// \param radiance of directions from the shading point to the light, a function that takes a unit vector and returns Vec3<T>:
///                 finite and not negative [W/(sr m^2)].
/// \param typical  of the light: its mean radiance, say. 0 for a light that no direction misses.
/// Edge cases: a line through the shading point has nodes at equal lengths, and so has a line without length.
template <int n = 32, class T, class Radiance>
NUSSELT_HD inline LineNodes<T, n> make_line_nodes(const LineSegment<T>& light, const T& typical,
                                                  const Radiance& radiance) noexcept {
    using Nodes = LineNodes<T, n>;
    Nodes nodes{};
    // In units of the distance r of the start: sine and cosine of the angle between it and the closest point of the line. At an
    // angle d from the start, the point is at the length r sin(d) / cos(angle + d), which does not cancel.
    const T distance = nusselt::length(light.p0);
    const T inverse = distance > T(0) ? T(1) / distance : T(0);
    const T sine = dot(inverse * light.p0, light.s);
    const T cosine = nusselt::length(inverse * light.p0 - sine * light.s);
    const T extent = light.length * inverse;
    const T angle = std::atan2(cosine * extent, T(1) + sine * extent);
    bool is_increasing = extent > T(0) && is_finite(extent);
    for (int k = 0; k <= Nodes::kSlots; ++k) {
        const T d = angle * (static_cast<T>(k) / static_cast<T>(n));
        const T along = cosine * std::cos(d) - sine * std::sin(d);
        nodes.border[k] = k == 0 ? T(0) : k < n ? std::sin(d) / (along * extent) : T(1);
        if (k > 0 && k <= n) is_increasing = is_increasing && nodes.border[k] > nodes.border[k - 1];
    }
    for (int k = 1; k < n && !is_increasing; ++k) nodes.border[k] = static_cast<T>(k) / static_cast<T>(n);
    T largest = typical;
    Vec3<T> here{};
    for (int k = 0; k <= Nodes::kSlots; ++k) {
        const Vec3<T> p = fma(nodes.border[k] * light.length, light.s, light.p0);
        if (k <= n) here = radiance(normalize(p));
        nodes.radiance[0][k] = here.x;
        nodes.radiance[1][k] = here.y;
        nodes.radiance[2][k] = here.z;
        nodes.value[k] = mean_of_channels(here);
        largest = max(largest, nodes.value[k]);
    }
    for (T& value : nodes.value) value = max(value, T(kLeastNodeShare) * largest);
    return nodes;
}

NUSSELT_NAMESPACE_END
