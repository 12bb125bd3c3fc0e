#include "scene/model/lights/round/round_shell.h"

#include "scene/model/lights/round/round_axes.h"

#include <array>
#include <cmath>

namespace nusselt::scene {

std::vector<double> round_shells(const Scene& scene) {
    const std::vector<RoundLight>& lights = scene.lights.of<RoundLight>();
    std::vector<double> shells(lights.size(), 1);
    if (lights.empty()) return shells;
    std::vector<RoundAxes> axes;
    for (const RoundLight& light : lights) axes.emplace_back(light);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::int64_t index = round_light_of(scene, i);
        if (index < 0) continue;
        const auto number = static_cast<std::size_t>(index);
        if (is_flat(lights[number])) continue;
        std::array<Double3, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = axes[number].unit(to_double(scene.positions[scene.triangles[i].vertex[k]]) -
                                     to_double(lights[number].center));
        const double distance = std::fabs(dot(normalized(cross(p[1] - p[0], p[2] - p[0])), p[0]));
        // Comparisons with NaN, of triangles without area, are false.
        if (distance < shells[number]) shells[number] = distance;
    }
    return shells;
}

} // namespace nusselt::scene
