#include "picking.h"

#include "scene/model/lights/light_geometry.h"
#include "scene/model/transform.h"
#include "scene/model/vector_math.h"
#include "scene/rig/light_edit.h"

#include <limits>
#include <vector>

namespace nusselt::viewer {

namespace {

using scene::Double3;

/// The largest distance of a click from a thin light that selects it [pixels].
constexpr double kTolerance = 4;

scene::SightRay ray_through(const scene::Camera& camera, FilmPosition at) {
    return {to_double(camera.origin) + at.x * to_double(camera.origin_right) +
                at.y * to_double(camera.origin_down),
            to_double(camera.corner) + at.x * to_double(camera.right) + at.y * to_double(camera.down),
            kTolerance * to_double(camera.origin_right), kTolerance * to_double(camera.right)};
}

/// The lights of an emitter where an edit puts them.
scene::Lights placed(const scene::EditableLight& light, const LightEdit& edit) {
    const Double3 center = centroid(light);
    const scene::Transform transform = scene::translation(center + edit.move) *
                                       scene::scaling({edit.size, edit.size, edit.size}) *
                                       scene::translation(-1.0 * center);
    scene::Lights lights = light.parts;
    for (scene::LightList& list : lights) list.transform(transform);
    return lights;
}

} // namespace

std::optional<std::size_t> light_at(const scene::Scene& loaded, const LightEdits& edits,
                                    const scene::Camera& camera, FilmPosition position) {
    const scene::SightRay ray = ray_through(camera, position);
    const std::vector<scene::EditableLight> lights = editable_lights(loaded);
    std::optional<std::size_t> nearest;
    double nearest_t = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!edits.get(i).is_enabled) continue;
        const scene::Lights parts = placed(lights[i], edits.get(i));
        for (const scene::LightList& list : parts) {
            for (std::size_t k = 0; k < list.size(); ++k) {
                const double t = list.hit(k, ray);
                if (t >= nearest_t) continue;
                nearest_t = t;
                nearest = i;
            }
        }
    }
    return nearest;
}

scene::Double3 drag_of(const scene::Scene& loaded, const LightEdits& edits, std::size_t light,
                       const scene::Camera& camera, FilmPosition from, FilmPosition to) {
    const scene::EditableLight dragged = editable_lights(loaded)[light];
    const Double3 center = centroid(dragged) + edits.get(light).move;
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
