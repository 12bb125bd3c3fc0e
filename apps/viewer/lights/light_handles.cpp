#include "light_handles.h"

#include "scene/model/bounds.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nusselt::viewer {

namespace {

using scene::Double3;

constexpr double kLength = 0.1;     ///< of an arrow, of the width of the image
constexpr double kRingRadius = 0.7; ///< of a ring, of the length of an arrow
constexpr int kRingLines = 48;
/// Lights with more lines show their bounding box: drivers draw 65536 corners at once.
constexpr std::size_t kMostLines = 4000;

Double3 axis_vector(std::size_t axis) {
    return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

/// The distance of a point from a line [pixels].
double distance(FilmPosition p, const std::pair<FilmPosition, FilmPosition>& line) {
    const double x = line.second.x - line.first.x;
    const double y = line.second.y - line.first.y;
    const double squared = x * x + y * y;
    const double along = squared > 0 ? ((p.x - line.first.x) * x + (p.y - line.first.y) * y) / squared : 0;
    const double at = std::clamp(along, 0.0, 1.0);
    return std::hypot(line.first.x + at * x - p.x, line.first.y + at * y - p.y);
}

void add_line(const scene::Camera& camera, const Double3& begin, const Double3& end, FilmLines& lines) {
    if (const auto line = seen_line(camera, begin, end)) lines.push_back(*line);
}

void add_box(const scene::Bounds& box, const scene::Camera& camera, FilmLines& lines) {
    const auto corner = [&](std::size_t i) {
        return Double3{(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                       (i & 4) != 0 ? box.high.z : box.low.z};
    };
    for (std::size_t i = 0; i < 8; ++i)
        for (const std::size_t bit : {1u, 2u, 4u})
            if ((i & bit) == 0) add_line(camera, corner(i), corner(i | bit), lines);
}

/// The edge of what is seen of convex bodies: the convex hull of their corners, by Andrew's monotone chain.
void add_hull(std::vector<FilmPosition> corners, FilmLines& lines) {
    if (corners.size() < 2) return;
    std::sort(corners.begin(), corners.end(),
              [](FilmPosition a, FilmPosition b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    const auto turns_right = [](FilmPosition a, FilmPosition b, FilmPosition c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0;
    };
    std::vector<FilmPosition> hull;
    const auto add_chain = [&](auto begin, auto end) {
        const std::size_t first = hull.size();
        for (auto at = begin; at != end; ++at) {
            while (hull.size() > first + 1 && turns_right(hull[hull.size() - 2], hull.back(), *at))
                hull.pop_back();
            hull.push_back(*at);
        }
        hull.pop_back();
    };
    add_chain(corners.begin(), corners.end());
    add_chain(corners.rbegin(), corners.rend());
    for (std::size_t i = 0; i < hull.size(); ++i) lines.emplace_back(hull[i], hull[(i + 1) % hull.size()]);
}

} // namespace

LightHandles::LightHandles(const Double3& center_of_light, const scene::Camera& camera, double width)
    : center(center_of_light) {
    const auto seen = seen_at(camera, center);
    if (!seen) return;
    const Double3 way = drag_of(center, camera, *seen, {seen->x + kLength * width, seen->y});
    length = scene::length(way);
}

FilmLines LightHandles::lines(const Handle& handle, const scene::Camera& camera) const {
    FilmLines lines;
    if (!(length > 0)) return lines;
    const Double3 axis = axis_vector(handle.axis);
    if (handle.action == HandleAction::move) {
        add_line(camera, center, center + length * axis, lines);
        return lines;
    }
    const Double3 x = axis_vector((handle.axis + 1) % 3);
    const Double3 y = axis_vector((handle.axis + 2) % 3);
    const auto point = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / kRingLines;
        return center + (kRingRadius * length) * (std::cos(angle) * x + std::sin(angle) * y);
    };
    for (int i = 0; i < kRingLines; ++i) add_line(camera, point(i), point(i + 1), lines);
    return lines;
}

std::optional<Handle> LightHandles::at(FilmPosition position, const scene::Camera& camera,
                                       double tolerance) const {
    std::optional<Handle> nearest;
    for (const Handle& handle : kHandles) {
        for (const auto& line : lines(handle, camera)) {
            const double distance_of_line = distance(position, line);
            if (distance_of_line >= tolerance) continue;
            tolerance = distance_of_line;
            nearest = handle;
        }
    }
    return nearest;
}

Double3 drag_along(std::size_t axis, const Double3& center, const scene::Camera& camera, FilmPosition from,
                   FilmPosition to) {
    const Double3 direction = axis_vector(axis);
    // The point of the axis that is closest to a ray.
    const auto along = [&](FilmPosition at) {
        const scene::SightRay ray = ray_through(camera, at);
        const Double3 sight = normalized(ray.direction);
        const Double3 between = ray.origin - center;
        const double mixed = dot(direction, sight);
        return (dot(direction, between) - mixed * dot(sight, between)) / (1 - mixed * mixed);
    };
    const double way = along(to) - along(from);
    return std::isfinite(way) ? way * direction : Double3{};
}

Double3 turn_about(std::size_t axis, const Double3& center, const scene::Camera& camera, FilmPosition from,
                   FilmPosition to) {
    const Double3 direction = axis_vector(axis);
    const Double3 x = axis_vector((axis + 1) % 3);
    const Double3 y = axis_vector((axis + 2) % 3);
    // The angle at which a ray meets the plane of the ring.
    const auto angle = [&](FilmPosition at) {
        const scene::SightRay ray = ray_through(camera, at);
        const double t = dot(center - ray.origin, direction) / dot(ray.direction, direction);
        const Double3 p = ray.origin + t * ray.direction - center;
        return std::atan2(dot(p, y), dot(p, x));
    };
    const double turn = std::remainder(angle(to) - angle(from), 2 * std::numbers::pi);
    return std::isfinite(turn) ? (180 / std::numbers::pi * turn) * direction : Double3{};
}

FilmLines outline(const scene::Lights& parts, const scene::Camera& camera) {
    FilmLines lines;
    for (const scene::PolygonLight& part : parts.of<scene::PolygonLight>())
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
            add_line(camera, to_double(part.vertices[i]),
                     to_double(part.vertices[(i + 1) % part.vertices.size()]), lines);
    const auto add_hull_of = [&](const std::vector<scene::Float3>& positions) {
        std::vector<FilmPosition> corners;
        for (const scene::Float3& p : positions)
            if (const auto at = seen_at(camera, to_double(p))) corners.push_back(*at);
        add_hull(corners, lines);
    };
    for (const scene::RoundLight& part : parts.of<scene::RoundLight>())
        add_hull_of(scene::surface(part, scene::kRoundSides).positions);
    for (const scene::LightList& list : parts) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            scene::LightMesh mesh;
            list.add_mesh(i, mesh);
            add_hull_of(mesh.positions);
        }
    }
    if (lines.size() <= kMostLines) return lines;
    scene::Bounds box;
    for (const scene::LightList& list : parts) list.add_to(box);
    lines.clear();
    add_box(box, camera, lines);
    return lines;
}

} // namespace nusselt::viewer
