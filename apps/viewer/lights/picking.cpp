#include "picking.h"

#include "scene/model/vector_math.h"
#include "scene/rig/light_edit.h"

#include <limits>
#include <vector>

namespace nusselt::viewer {

namespace {

using scene::Double3;

/// The largest distance of a click from a thin light that selects it [pixels].
constexpr double kTolerance = 4;
/// Points nearer than this fraction of the distance at which a pixel of the film lies count as behind the camera.
constexpr double kNearest = 1e-3;

/// A point of the film in homogeneous coordinates: x / w and y / w. A positive `depth` is in front of the camera.
struct HomogeneousPosition {
    double x, y, w, depth;
};

/// Solves p = a right + b down + t corner.
Double3 coordinates(const Double3& right, const Double3& down, const Double3& corner, const Double3& p) {
    const double determinant = dot(right, cross(down, corner));
    return (1 / determinant) *
           Double3{dot(p, cross(down, corner)), dot(p, cross(corner, right)), dot(p, cross(right, down))};
}

HomogeneousPosition project(const scene::Camera& camera, const Double3& point) {
    const Double3 way = point - to_double(camera.origin);
    const bool is_perspective = length(to_double(camera.origin_right)) == 0;
    const Double3 at =
        is_perspective
            ? coordinates(to_double(camera.right), to_double(camera.down), to_double(camera.corner), way)
            : coordinates(to_double(camera.origin_right), to_double(camera.origin_down),
                          to_double(camera.corner), way);
    return {at.x, at.y, is_perspective ? at.z : 1, at.z};
}

FilmPosition position_of(const HomogeneousPosition& at) { return {at.x / at.w, at.y / at.w}; }

std::optional<double> nearest_hit(const scene::Lights& parts, const scene::SightRay& ray) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const scene::LightList& list : parts)
        for (std::size_t k = 0; k < list.size(); ++k) nearest = std::min(nearest, list.hit(k, ray));
    if (nearest < std::numeric_limits<double>::infinity()) return nearest;
    return std::nullopt;
}

} // namespace

scene::SightRay ray_through(const scene::Camera& camera, FilmPosition at) {
    return {to_double(camera.origin) + at.x * to_double(camera.origin_right) +
                at.y * to_double(camera.origin_down),
            to_double(camera.corner) + at.x * to_double(camera.right) + at.y * to_double(camera.down),
            kTolerance * to_double(camera.origin_right), kTolerance * to_double(camera.right)};
}

std::optional<FilmPosition> seen_at(const scene::Camera& camera, const Double3& point) {
    const HomogeneousPosition at = project(camera, point);
    if (!(at.depth >= kNearest)) return std::nullopt;
    return position_of(at);
}

std::optional<std::pair<FilmPosition, FilmPosition>> seen_line(const scene::Camera& camera,
                                                               const Double3& begin, const Double3& end) {
    HomogeneousPosition a = project(camera, begin);
    HomogeneousPosition b = project(camera, end);
    if (!(a.depth >= kNearest || b.depth >= kNearest)) return std::nullopt;
    const auto cut = [](const HomogeneousPosition& front, const HomogeneousPosition& back) {
        const double s = (kNearest - front.depth) / (back.depth - front.depth);
        const auto mix = [&](double from, double to) { return from + s * (to - from); };
        return HomogeneousPosition{mix(front.x, back.x), mix(front.y, back.y), mix(front.w, back.w),
                                   kNearest};
    };
    if (a.depth < kNearest) a = cut(b, a);
    if (b.depth < kNearest) b = cut(a, b);
    return std::pair(position_of(a), position_of(b));
}

std::optional<std::size_t> light_at(const scene::Scene& loaded, const LightEdits& edits,
                                    const scene::Camera& camera, FilmPosition position) {
    const scene::SightRay ray = ray_through(camera, position);
    const std::vector<scene::EditableLight> lights = editable_lights(loaded);
    std::optional<std::size_t> nearest;
    double nearest_t = std::numeric_limits<double>::infinity();
    for (const std::size_t i : edits.lights(loaded)) {
        const LightEdit edit = edits.get(i);
        if (!edit.is_enabled) continue;
        const auto t = nearest_hit(edit.added ? edits.placed(loaded, i) : placed(lights[i].parts, edit), ray);
        if (!t || *t >= nearest_t) continue;
        nearest_t = *t;
        nearest = i;
    }
    return nearest;
}

Double3 drag_of(const Double3& center, const scene::Camera& camera, FilmPosition from, FilmPosition to) {
    const scene::SightRay begin = ray_through(camera, from);
    const scene::SightRay end = ray_through(camera, to);
    // Rays reach planes parallel to the image at a distance that is linear in the depth.
    const Double3 normal = cross(to_double(camera.right) + to_double(camera.origin_right),
                                 to_double(camera.down) + to_double(camera.origin_down));
    const auto distance = [&](const scene::SightRay& ray) {
        return dot(center - ray.origin, normal) / dot(ray.direction, normal);
    };
    if (!(distance(begin) > 0 && distance(end) > 0)) return {};
    return (end.origin + distance(end) * end.direction) - (begin.origin + distance(begin) * begin.direction);
}

} // namespace nusselt::viewer
