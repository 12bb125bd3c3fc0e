#pragma once
/// Whether light leaks between the triangles of closed meshes.

#include <cstdint>
#include <vector>

#include "experiments/shadows/closed_meshes.h"
#include "experiments/shadows/cut_by_mesh.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

/// A point in a closed mesh, and a light outside: nothing of the light may be visible.
struct LeakCase {
    std::vector<Triangle<float>> triangles; ///< corners in either winding
    Vec3<float> point;
    ConvexPolygon<float, 4> light;
    float angle; ///< of the lines, see LineFamily
    float u[kLinesPerCase];
    int corner[kLinesPerCase]; ///< of the mesh, through which the line passes; negative: see u
};

namespace detail {

/// How far a point can go before it meets the mesh, in units of the direction.
inline double distance_to_surface(const Mesh& mesh, const Vec3<double>& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3<double> a = mesh.vertices[i] - mesh.inside;
        const Vec3<double> b = mesh.vertices[j] - mesh.inside;
        const Vec3<double> c = mesh.vertices[k] - mesh.inside;
        const double x = dot(cross(b, c), direction), y = dot(cross(c, a), direction),
                     z = dot(cross(a, b), direction);
        const bool in_cone = (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
        const Vec3<double> normal = cross(b - a, c - a);
        const double distance = dot(normal, a) / dot(normal, direction);
        if (in_cone && distance > 0) nearest = std::min(nearest, distance);
    }
    return nearest;
}

inline Vec3<float> rounded(const Vec3<double>& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

} // namespace detail

/// \param index of the case; cases depend on it and the seed only.
inline LeakCase make_leak_case(std::uint64_t seed, std::uint64_t index) {
    hostile::RandomSource random(seed, index);
    Mesh mesh = make_closed_mesh(random);
    // Some stay aligned with the axes, as walls are.
    if (random.index(3) > 0) {
        const Vec3<double> x = random.direction();
        const Vec3<double> y = normalize(cross(x, random.direction()));
        const Vec3<double> size{random.log_between(0.1, 1), random.log_between(0.1, 1), 1};
        const auto map = [&](const Vec3<double>& v) {
            return (size.x * v.x) * x + (size.y * v.y) * y + (size.z * v.z) * cross(x, y);
        };
        for (Vec3<double>& v : mesh.vertices) v = map(v);
        mesh.inside = map(mesh.inside);
    }

    // Towards the surface, but not so close that rounding could move it to the other side.
    const Vec3<double> towards = random.direction();
    const double share = random.index(2) == 0 ? random.uniform() : 1 - random.log_between(1e-3, 1);
    Vec3<double> point = mesh.inside;
    const double reach = detail::distance_to_surface(mesh, towards);
    if (reach < 100) point = point + (0.999 * share * reach) * towards;

    double radius = 0;
    for (const Vec3<double>& v : mesh.vertices) radius = std::max(radius, length(v - point));
    const double distance = radius * (1 + random.log_between(0.02, 1000));
    const double room = distance - 1.01 * radius;
    const Vec3<double> axis = random.index(3) == 0 ? Vec3<double>{0, 0, 1} : random.direction();
    const Vec3<double> side = normalize(cross(axis, random.direction()));
    // Any light in this ball, or any in the plane through its centre across the axis, is outside.
    const bool is_tilted = random.index(2) == 0;
    const double size =
        is_tilted ? room * random.log_between(1e-4, 0.7) : radius * random.log_between(1e-4, 1e2);
    const Vec3<double> other = is_tilted ? normalize(cross(side, random.direction())) : cross(axis, side);
    const Vec3<double> center = point + distance * axis;

    const double unit = random.index(2) == 0 ? 1 : random.log_between(1e-3, 1e3);
    const Vec3<double> shift =
        random.index(2) == 0 ? Vec3<double>{0, 0, 0} : (5 * radius) * random.direction();
    const auto place = [&](const Vec3<double>& v) { return detail::rounded(unit * (v + shift)); };
    LeakCase result;
    result.point = place(point);
    for (const auto& [a, b, c] : mesh.triangles)
        result.triangles.push_back(
            {place(mesh.vertices[a]), place(mesh.vertices[b]), place(mesh.vertices[c])});
    Vec3<float> vertices[4];
    for (int i = 0; i < 4; ++i) {
        const double x = i == 1 || i == 2 ? 0.7 : -0.7, y = i >= 2 ? 0.7 : -0.7;
        vertices[i] = place(center + (size * x) * side + (size * y) * other);
    }
    result.light = make_polygon<4>(vertices, 4);
    result.angle = random.index(4) == 0 ? 0 : static_cast<float>(random.between(0, kPi<double>));
    for (int i = 0; i < kLinesPerCase; ++i) {
        result.u[i] = std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f);
        result.corner[i] =
            random.index(4) == 0 ? random.index(static_cast<int>(3 * mesh.triangles.size())) : -1;
    }
    return result;
}

/// Calls `use` with the offsets of the lines of a case, their extents on the light and a function that calls its argument
/// with the part of each line that an occluder hides, for all occluders.
/// \param order applied to each triangle beforehand.
template <class Order, class Use>
void with_lines(const LeakCase& test, const Order& order, const Use& use) {
    const LineFamily<float, 4> family(test.light, test.angle);
    const ShadowFrame<float> frame = make_shadow_frame(family.plane(), test.point);
    const Interval<float> offsets = family.offsets();
    float offset[kLinesPerCase];
    for (int i = 0; i < kLinesPerCase; ++i) {
        offset[i] = family.sample_uniform(test.u[i]).offset;
        if (test.corner[i] < 0) continue;
        const auto& triangle = test.triangles[static_cast<std::size_t>(test.corner[i] / 3)];
        const float knot =
            nusselt::detail::shadow_corner(frame, triangle[static_cast<std::size_t>(test.corner[i] % 3)])
                .offset;
        if (knot >= offsets.begin && knot < offsets.end) offset[i] = knot;
    }
    std::vector<Triangle<float>> triangles;
    for (const Triangle<float>& triangle : test.triangles) triangles.push_back(order(triangle));
    const Lines packed = Lines::load(offset);
    const Interval<Lines> whole = LineFamily<Lines, 4>(family).chord(packed).extent;
    LineBounds<float> bounds{offsets, empty_interval<float>()};
    for (int i = 0; i < kLinesPerCase; ++i) {
        bounds.extent.begin = std::min(bounds.extent.begin, whole.begin.lane(i));
        bounds.extent.end = std::max(bounds.extent.end, whole.end.lane(i));
    }
    use(packed, whole, [&](const auto& each) {
        for_each_shadow<kLinesPerCase>(frame, triangles, bounds,
                                       [&](const auto& shadow) { each(hidden_from(shadow, packed)); });
    });
}

/// Lines of which something is visible although no gap may be left, however short.
/// \param order applied to each triangle beforehand, as in_order_of_position().
/// \param alter applied to what a triangle hides of lines.
template <class Order, class Alter>
int count_leaks(const LeakCase& test, const Order& order, const Alter& alter) {
    int leaks = 0;
    with_lines(test, order, [&](const Lines&, const Interval<Lines>& whole, const auto& for_each) {
        std::vector<Interval<float>> hidden[kLinesPerCase];
        for_each([&](const Interval<Lines>& all) {
            const Interval<Lines> part = alter(all);
            const std::uint32_t hides = (part.begin < part.end).bits();
            if (hides == 0) return;
            float begin[kLinesPerCase], end[kLinesPerCase];
            part.begin.store(begin);
            part.end.store(end);
            for (int i = 0; i < kLinesPerCase; ++i)
                if ((hides >> i & 1u) != 0) hidden[i].push_back({begin[i], end[i]});
        });
        for (int i = 0; i < kLinesPerCase; ++i) {
            std::sort(hidden[i].begin(), hidden[i].end(),
                      [](const auto& a, const auto& b) { return a.begin < b.begin; });
            float dark_until = whole.begin.lane(i);
            for (const Interval<float>& part : hidden[i])
                if (part.begin <= dark_until) dark_until = std::max(dark_until, part.end);
            leaks += dark_until < whole.end.lane(i);
        }
    });
    return leaks;
}

/// The same with VisibleParts. \returns lines of which it finds something visible
inline int count_visible(const LeakCase& test) {
    int visible = 0;
    with_lines(test, in_order_of_position<float>,
               [&](const Lines&, const Interval<Lines>& whole, const auto& for_each) {
                   Interval<Lines> storage[64];
                   VisibleParts<Lines> parts(storage, 64);
                   parts.reset(whole);
                   for_each([&](const Interval<Lines>& hidden) { parts.cut(hidden); });
                   for (int i = 0; i < kLinesPerCase; ++i) visible += parts.lit().lane(i);
               });
    return visible;
}

} // namespace shadows
NUSSELT_NAMESPACE_END
