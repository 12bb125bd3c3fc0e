#pragma once
/// How much the radiance of a polygon varies over the directions in which a point sees it: whether samples in proportion to it
/// (windowed_polygon.h) are worth their cost.
///
/// Samples of a solid angle, times radiance, have a relative variance of about window_variation(): cosines and horizons may make
/// it larger. They cost a small part of those of cells. A renderer takes them for points where it is at most kLittleVariation.
/// This is a property of light and point, never of random numbers, so that neither way of sampling is biased.

#include <nusselt/emission/windowed_light.h>

NUSSELT_NAMESPACE_BEGIN

/// The largest window_variation() for which samples of the measure alone are to be preferred: their noise without shadows is then
/// about 0.3 at most. Cells take four times as long or more, and have noise of their own, all the more in penumbrae.
template <class T>
inline constexpr T kLittleVariation = T(1) / 12;

/// The squared coefficient of variation of radiance by solid angle, over the texels of the bounding box of the light in its
/// frame and those next to them: nothing in this box, such as the edge of a sun, is left out.
/// \tparam T    float, double or long double. \param light its side that faces the point.
/// \param plane of the light seen from a point: to_shading_space(light.plane, point, frame), in any frame.
/// \returns 0 or more; infinity if the light reaches beyond the domain of its table, where it is black; 0 if all of the box is
///          black, for points beyond or in the plane of the light, and for lights so huge or near that WindowedPolygon has
///          no samples of them: those whose extent is about kLargestSlope times the distance or more.
template <class T>
NUSSELT_HD inline T window_variation(const WindowPlane<T>& plane, const WindowedLight<T>& light) noexcept {
    const RectifiedTable<T>& table = light.table;
    const T distance = dot(plane.frame.n, plane.corner);
    if (!(distance > T(0)) || !(table.mean > T(0))) return T(0);

    const TextureOutline<T>& outline = light.outline;
    Vec2<T> low = outline.vertex[0];
    Vec2<T> high = low;
    for (int k = 1; k < outline.count; ++k) {
        low = {min(low.x, outline.vertex[k].x), min(low.y, outline.vertex[k].y)};
        high = {max(high.x, outline.vertex[k].x), max(high.y, outline.vertex[k].y)};
    }
    const Vec2<T> corner{dot(plane.frame.t, plane.corner), dot(plane.frame.b, plane.corner)};
    low = low + corner;
    high = high + corner;
    // Half of the limit of WindowedPolygon, whose distance is rounded in another way.
    const T reach = max(max(abs(low.x), abs(high.x)), max(abs(low.y), abs(high.y)));
    if (!(distance * (kLargestSlope<T> / 2) > reach)) return T(0);

    // A slope of z = 1 may lie beyond the domain by rounding.
    constexpr T kRounding = 64 * std::numeric_limits<T>::epsilon();
    const auto is_within = [&](const T& from, const T& to, const T& begin, const T& end) {
        const T rounding = kRounding * (abs(from) + abs(to) + distance);
        return from >= begin * distance - rounding && to <= end * distance + rounding;
    };
    if (!is_within(low.x, high.x, table.domain.low.x, table.domain.high.x) ||
        !is_within(low.y, high.y, table.domain.low.y, table.domain.high.y))
        return std::numeric_limits<T>::infinity();

    const auto texel_at = [&](const T& offset, const T& angle_low, const T& texel_size, int count) {
        const T angle = copysign(atan2_positive(abs(offset), distance), offset);
        // Also for angles that are not numbers.
        const T position = min(max((angle - angle_low) / texel_size, T(0)), static_cast<T>(count));
        return detail::clamp_index(detail::floor_to_int(position), count);
    };
    const auto before = [](int texel) { return texel > 0 ? texel - 1 : 0; };
    const auto after = [](int texel, int count) { return texel + 2 < count ? texel + 2 : count; };
    const RectifiedSums sums =
        table.sum(before(texel_at(low.x, table.angle_low.x, table.texel_size.x, table.width)),
                  after(texel_at(high.x, table.angle_low.x, table.texel_size.x, table.width), table.width),
                  before(texel_at(low.y, table.angle_low.y, table.texel_size.y, table.height)),
                  after(texel_at(high.y, table.angle_low.y, table.texel_size.y, table.height), table.height));
    const T weight = static_cast<T>(sums.weight);
    if (!(weight > T(0))) return T(0);
    return max(table.mean_square * (static_cast<T>(sums.square) / weight) *
                       (static_cast<T>(sums.solid_angle) / weight) -
                   T(1),
               T(0));
}

NUSSELT_NAMESPACE_END
