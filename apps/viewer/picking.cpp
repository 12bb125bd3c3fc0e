#include "picking.h"

#include "scene/model/vector_math.h"
#include "scene/rig/light_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nusselt::viewer {

namespace {

using scene::Double3;

/// How far beside a thin tube a click may be [pixels].
constexpr double kTubeTolerance = 4;

struct Ray {
    Double3 origin, direction;
};

Ray ray_through(const scene::Camera& camera, FilmPosition at) {
    return {to_double(camera.origin) + at.x * to_double(camera.origin_right) +
                at.y * to_double(camera.origin_down),
            to_double(camera.corner) + at.x * to_double(camera.right) + at.y * to_double(camera.down)};
}

/// How far the rays of neighbouring pixels are from each other at a distance in units of their direction [m].
double pixel_width(const scene::Camera& camera, double t) {
    return length(to_double(camera.origin_right) + t * to_double(camera.right));
}

/// Where an edit puts a point of a light.
struct Placement {
    Double3 centroid;
    LightEdit edit;

    Double3 operator()(const scene::Float3& p) const {
        return centroid + edit.size * (to_double(p) - centroid) + edit.move;
    }
};

/// Distance in units of the direction; infinite for a miss.
double hit_polygon(const Ray& ray, const std::vector<Double3>& corners) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    // Newell's normal is right also where three corners are on a line.
    Double3 normal;
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal = normal + cross(corners[i], corners[(i + 1) % corners.size()]);
    const double t = dot(corners[0] - ray.origin, normal) / dot(ray.direction, normal);
    if (!(t > 0)) return kMiss;
    const Double3 p = ray.origin + t * ray.direction;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Double3& corner = corners[i];
        const Double3 edge = corners[(i + 1) % corners.size()] - corner;
        if (dot(cross(edge, p - corner), normal) < 0) return kMiss;
    }
    return t;
}

/// Likewise, of the point of the ray that is closest to the axis.
double hit_tube(const Ray& ray, const Double3& begin, const Double3& end, double radius,
                const scene::Camera& camera) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    const Double3 axis = end - begin;
    const Double3 between = begin - ray.origin;
    const double axis_squared = dot(axis, axis);
    const double direction_squared = dot(ray.direction, ray.direction);
    const double mixed = dot(axis, ray.direction);
    const double determinant = axis_squared * direction_squared - mixed * mixed;
    double along = 0.5;
    if (determinant > 0)
        along = (mixed * dot(ray.direction, between) - direction_squared * dot(axis, between)) / determinant;
    const Double3 on_axis = begin + std::clamp(along, 0.0, 1.0) * axis;
    const double t = dot(on_axis - ray.origin, ray.direction) / direction_squared;
    if (!(t > 0)) return kMiss;
    const double distance = length(ray.origin + t * ray.direction - on_axis);
    return distance <= std::max(radius, kTubeTolerance * pixel_width(camera, t)) ? t : kMiss;
}

} // namespace

std::optional<std::size_t> light_at(const scene::Scene& loaded, const LightEdits& edits,
                                    const scene::Camera& camera, FilmPosition position) {
    const Ray ray = ray_through(camera, position);
    const std::vector<scene::EditableLight> lights = editable_lights(loaded);
    std::optional<std::size_t> nearest;
    double nearest_t = std::numeric_limits<double>::infinity();
    const auto hit = [&](double t, std::size_t light) {
        if (t >= nearest_t) return;
        nearest_t = t;
        nearest = light;
    };
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Placement placed{centroid(lights[i]), edits.get(i)};
        if (!placed.edit.is_enabled) continue;
        for (const scene::PolygonLight& polygon : lights[i].polygons) {
            std::vector<Double3> corners;
            for (std::size_t j = 0; j < polygon.vertices.size(); ++j)
                corners.push_back(placed(polygon.vertices[j]));
            hit(hit_polygon(ray, corners), i);
        }
        for (const scene::LineLight& tube : lights[i].tubes) {
            const double radius = placed.edit.size * static_cast<double>(tube.radius);
            hit(hit_tube(ray, placed(tube.start), placed(tube.end), radius, camera), i);
        }
    }
    return nearest;
}

scene::Double3 drag_of(const scene::Scene& loaded, const LightEdits& edits, std::size_t light,
                       const scene::Camera& camera, FilmPosition from, FilmPosition to) {
    const scene::EditableLight dragged = editable_lights(loaded)[light];
    const Double3 center = centroid(dragged) + edits.get(light).move;
    const Ray begin = ray_through(camera, from);
    const Ray end = ray_through(camera, to);
    // Rays reach planes parallel to the image at a distance that is linear in the depth.
    const Double3 normal = cross(to_double(camera.right) + to_double(camera.origin_right),
                                 to_double(camera.down) + to_double(camera.origin_down));
    const auto distance = [&](const Ray& ray) {
        return dot(center - ray.origin, normal) / dot(ray.direction, normal);
    };
    if (!(distance(begin) > 0 && distance(end) > 0)) return {};
    return (end.origin + distance(end) * end.direction) - (begin.origin + distance(begin) * begin.direction);
}

} // namespace nusselt::viewer
