#pragma once
/// Clipping of a convex polygon to the upper hemisphere for scalar code, which takes vertices as lanes. It has no GLSL twin.

#include <nusselt/geometry/convex_polygon.h>

#if NUSSELT_HAS_VERTEX_LANES

NUSSELT_NAMESPACE_BEGIN

/// The vertices of a polygon above the horizon, one after the other, without repetitions.
template <int Capacity>
struct Outline {
    int count = 0;
    Vec3<float> vertex[Capacity]; ///< from count on: vertex 0, unless there is none
    Vec3<float> edge[Capacity];   ///< to the next vertex, never of length zero; from count on: zero
};

/// clip_to_horizon() (clip_polygon.h) for scalar code, with vertices in the same order.
///
/// Has no vertices if nothing of the polygon is above the horizon, nor in two cases that the caller leaves to
/// clip_to_horizon(): if the polygon touches the horizon at one point, up to rounding, and if its boundary goes below the
/// horizon more than once. That of a convex polygon does so by rounding only, along the horizon.
/// \tparam Capacity at least N + 1.
template <int Capacity, int N>
inline Outline<Capacity> outline_above_horizon(const ConvexPolygon<float, N>& polygon) noexcept {
    static_assert(Capacity > N, "clipping adds a vertex");
    const auto next = [](int j) { return j + 1 < N ? j + 1 : 0; };

    // Find the vertices that stay, and the edges where the boundary goes below the horizon and comes up again. Without such
    // edges, the walk begins at vertex 0.
    bool stays[N];
    int fall = N - 1, rise = N - 1;
    int falls = 0, stay_count = 0, stay_after_rise = 0;
    NUSSELT_UNROLL
    for (int j = 0; j < N; ++j) {
        const bool above = polygon.vertex[j].z > 0;
        const bool next_above = polygon.vertex[next(j)].z > 0;
        const bool is_fall = above && !next_above;
        const bool is_rise = !above && next_above;
        stays[j] = above && detail::extent_of(polygon.edge[j]) > 0;
        falls += is_fall ? 1 : 0;
        fall = is_fall ? j : fall;
        rise = is_rise ? j : rise;
        stay_count += stays[j] ? 1 : 0;
        stay_after_rise = is_rise ? 0 : stay_after_rise + (stays[j] ? 1 : 0);
    }
    Outline<Capacity> outline;
    if (stay_count == 0 || falls > 1) return outline;
    const int count = stay_count + 2 * falls;

    // Walk from where the boundary comes up to where it goes down. The order of clip_to_horizon() begins with vertex 0 or
    // what replaces it.
    int slot = 0;
    float extents = 0;
    const auto add = [&](const Vec3<float>& position, const Vec3<float>& to_next) {
        outline.vertex[slot] = position;
        outline.edge[slot] = to_next;
        slot = slot + 1 < count ? slot + 1 : 0;
    };
    // A vertex on the horizon stays exactly where it is.
    const auto on_horizon = [](const Vec3<float>& v, float x, float y) {
        return Vec3<float>{v.z == 0 ? v.x : x, v.z == 0 ? v.y : y, 0};
    };
    if (falls == 1) {
        const bool begins_above = polygon.vertex[0].z > 0;
        slot = begins_above ? count - 1 - stay_after_rise : fall == N - 1 ? 1 : 0;
        const Vec3<float>&a = polygon.vertex[rise], &b = polygon.vertex[next(rise)], &e = polygon.edge[rise];
        const float share = b.z / (b.z - a.z);
        const Vec3<float> part{share * e.x, share * e.y, b.z};
        extents = detail::extent_of(e);
        add(on_horizon(a, b.x - part.x, b.y - part.y), part);
    }
    const auto add_edge = [&](int j) {
        if (!stays[j]) return;
        add(polygon.vertex[j], polygon.edge[j]);
        extents += detail::extent_of(polygon.edge[j]);
    };
    int j = next(rise);
    for (; j != fall; j = next(j)) add_edge(j);
    if (falls == 0) {
        add_edge(j);
    } else {
        const Vec3<float>&a = polygon.vertex[j], &b = polygon.vertex[next(j)], &e = polygon.edge[j];
        const float share = a.z / (a.z - b.z);
        const Vec3<float> part{share * e.x, share * e.y, -a.z};
        extents += detail::extent_of(e);
        if (stays[j]) add(a, part);
        // Close the polygon along the horizon. The sum has the order of clip_to_horizon(), so that it rounds alike; that of the
        // walk would make errors next to the plane of a light 4 % larger.
        const int horizon = slot;
        add(on_horizon(b, a.x + part.x, a.y + part.y), {0, 0, 0});
        Vec2<float> sum{0, 0};
        for (int k = 0; k < count; ++k) sum = sum + xy(outline.edge[k]);
        const float rounding = 4 * std::numeric_limits<float>::epsilon() * extents;
        if (max(abs(sum.x), abs(sum.y)) <= rounding) return outline;
        outline.edge[horizon] = {-sum.x, -sum.y, 0};
    }
    outline.count = count;
    for (int k = count; k < Capacity; ++k) {
        outline.vertex[k] = outline.vertex[0];
        outline.edge[k] = {0, 0, 0};
    }
    return outline;
}

NUSSELT_NAMESPACE_END
#endif
