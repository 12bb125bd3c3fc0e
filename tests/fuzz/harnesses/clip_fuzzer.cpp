/// Clipping to the horizon, by itself.

#include <limits>

#include <nusselt/geometry/clip_line.h>
#include <nusselt/geometry/clip_polygon.h>

#include "input.h"

namespace nusselt::fuzz {
namespace {

/// Rounding of a new vertex, relative to the farthest one.
template <class T>
T rounding(const hostile::Bounds<T>& bounds) {
    return 16 * (std::numeric_limits<T>::epsilon() * bounds.extent + std::numeric_limits<T>::min());
}

template <int N, class T>
void check_polygon(Input& input) {
    const ConvexPolygon<T, N> light = polygon<N, T>(input);
    const hostile::Bounds<T> bounds(light);
    const ConvexPolygon<T, N + 1> clipped = clip_to_horizon(light);
    const T slack = rounding(bounds);
    bool is_above = false;
    for (const Vec3<T>& v : light.vertex) is_above = is_above || v.z > 0;
    Vec3<T> sum{0, 0, 0};
    for (int j = 0; j <= N; ++j) {
        const Vec3<T>& v = clipped.vertex[j];
        sum = sum + clipped.edge[j];
        fail_if(!hostile::all_finite(v), "clip_to_horizon", "vertex is not finite", light);
        fail_if(!(v.z >= 0), "clip_to_horizon", "vertex is below the horizon", light);
        fail_if(is_above && !bounds.contain(v, slack), "clip_to_horizon", "vertex is off the light", light);
        fail_if(!is_above && (v.x != 0 || v.y != 0 || v.z != 0), "clip_to_horizon", "light from below",
                light);
    }
    fail_if(!(hostile::largest_coordinate(sum) <= slack), "clip_to_horizon", "edges do not close", light);
}

template <class T>
void check_line(Input& input) {
    const LineSegment<T> light = line<T>(input);
    const LineExtent<T> extent = clipped_extent(to_safe_extent(light));
    fail_if(!hostile::all_finite(extent.line.near) || !is_finite(extent.near_height()) ||
                !is_finite(extent.far_height()),
            "clipped_extent", "end is not finite", light);
    if (!extent.visible()) return;
    fail_if(!(extent.sine_extent().difference >= 0 && extent.sine_extent().difference <= T(2.001)),
            "clipped_extent", "not a difference of sines", light);
    fail_if(!(extent.area() <= T(1.001) * extent.product), "clipped_extent", "not a sine", light);
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt::fuzz;
    Input input(data, size);
    switch (input.byte() % 4) {
    case 0:
        check_polygon<4, float>(input);
        break;
    case 1:
        check_polygon<8, double>(input);
        break;
    case 2:
        check_line<float>(input);
        break;
    default:
        check_line<double>(input);
    }
    return 0;
}
