#pragma once
/// What a list of triangles leaves of the lines of a light, without any acceleration structure.

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

#include <nusselt/line_samples/partial_shadow.h>
#include <nusselt/line_samples/stored_shadows.h>

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

/// Lines that a case takes at once, whatever the instruction set.
inline constexpr int kLinesPerCase = 16;
using Lines = Pack<float, kLinesPerCase>;

template <class T>
using Triangle = std::array<Vec3<T>, 3>;

/// Sorts corners as make_triangle_shadow() asks for.
template <class T>
Triangle<T> in_order_of_position(Triangle<T> triangle) {
    std::sort(triangle.begin(), triangle.end(), [](const Vec3<T>& a, const Vec3<T>& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    return triangle;
}

/// Calls `use` with the shadow of each triangle, a TriangleShadow<T> or PartialShadow<T>, that may hide something in the
/// rectangle.
/// \tparam N triangles whose shadows are made at once.
template <int N, class T, class Use>
void for_each_shadow(const ShadowFrame<T>& frame, const std::vector<Triangle<T>>& triangles,
                     const LineBounds<T>& bounds, const Use& use) {
    using Real = Pack<T, N>;
    const LineBounds<Real> rectangle{{bounds.offsets.begin, bounds.offsets.end},
                                     {bounds.extent.begin, bounds.extent.end}};
    const ShadowFrame<Real> frames = broadcast<Real>(frame);
    for (std::size_t first = 0; first < triangles.size(); first += N) {
        const std::size_t count = std::min(triangles.size() - first, static_cast<std::size_t>(N));
        T column[3][3][N];
        for (std::size_t i = 0; i < N; ++i) {
            const Triangle<T>& triangle = triangles[first + std::min(i, count - 1)];
            for (int k = 0; k < 3; ++k) {
                column[k][0][i] = triangle[k].x;
                column[k][1][i] = triangle[k].y;
                column[k][2][i] = triangle[k].z;
            }
        }
        Vec3<Real> corner[3];
        for (int k = 0; k < 3; ++k)
            corner[k] = {Real::load(column[k][0]), Real::load(column[k][1]), Real::load(column[k][2])};
        const TriangleShadows<Real> made = make_triangle_shadow(frames, corner[0], corner[1], corner[2]);
        const StoredShadows<T, N> stored(made.shadow);
        const auto hides = may_hide(made.shadow, rectangle);
        for (int i = 0; i < static_cast<int>(count); ++i) {
            const Triangle<T>& triangle = triangles[first + static_cast<std::size_t>(i)];
            if (made.partial.lane(i))
                use(make_partial_shadow(frame, triangle[0], triangle[1], triangle[2]));
            else if (hides.lane(i))
                use(stored[i]);
        }
    }
}

/// The part of each line that a shadow hides.
template <class Real>
Interval<Real> hidden_from(const TriangleShadow<scalar_t<Real>>& shadow, const Real& offset) {
    return hidden_interval(broadcast<Real>(shadow), offset);
}
template <class Real>
Interval<Real> hidden_from(const PartialShadow<scalar_t<Real>>& shadow, const Real& offset) {
    return hidden_interval(shadow, offset);
}

} // namespace shadows
NUSSELT_NAMESPACE_END
