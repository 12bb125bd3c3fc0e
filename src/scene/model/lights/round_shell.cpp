#include "scene/model/lights/round_shell.h"

#include "scene/model/vector_math.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace nusselt::scene {

std::vector<double> round_shells(const Scene& scene) {
    const std::vector<RoundLight>& lights = scene.lights.of<RoundLight>();
    const auto first = static_cast<std::int64_t>(scene.lights.of<PolygonLight>().size());
    std::vector<double> shells(lights.size(), 1);
    if (lights.empty()) return shells;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::int64_t index = scene.triangle_light[i] - first;
        if (index < 0 || index >= static_cast<std::int64_t>(lights.size())) continue;
        const RoundLight& light = lights[static_cast<std::size_t>(index)];
        if (light.model == RoundModel::ellipse) continue;
        const Double3 axis[] = {to_double(light.u), to_double(light.v), to_double(light.w)};
        const double volume = dot(axis[0], cross(axis[1], axis[2]));
        std::array<Double3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            const Double3 offset =
                to_double(scene.positions[scene.triangles[i].vertex[k]]) - to_double(light.center);
            p[k] = {dot(cross(axis[1], axis[2]), offset) / volume,
                    dot(cross(axis[2], axis[0]), offset) / volume,
                    dot(cross(axis[0], axis[1]), offset) / volume};
        }
        const double distance = std::fabs(dot(normalized(cross(p[1] - p[0], p[2] - p[0])), p[0]));
        // Comparisons with NaN, of triangles without area, are false.
        double& shell = shells[static_cast<std::size_t>(index)];
        if (distance < shell) shell = distance;
    }
    return shells;
}

} // namespace nusselt::scene
