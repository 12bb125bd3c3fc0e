#pragma once
/// Scenes with spheres, disks, ellipsoids and ellipses.

#include "scenes.h"

#include "scene/model/lights/light_geometry.h"
#include "scene/model/vector_math.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace nusselt::render_test {

/// Adds triangles of one material. \param light the number of their light, or the first of one for each triangle
inline void add_surface(scene::Scene& scene, const scene::LightSurface& surface, std::int32_t light,
                        bool has_many_lights) {
    const auto base = static_cast<std::uint32_t>(scene.positions.size());
    scene.positions.insert(scene.positions.end(), surface.positions.begin(), surface.positions.end());
    scene.normals.insert(scene.normals.end(), surface.normals.begin(), surface.normals.end());
    scene.uvs.insert(scene.uvs.end(), surface.uvs.begin(), surface.uvs.end());
    for (const scene::Triangle& triangle : surface.triangles) {
        const auto& vertex = triangle.vertex;
        scene.triangles.push_back({{base + vertex[0], base + vertex[1], base + vertex[2]}});
        scene.triangle_material.push_back(0);
        scene.triangle_light.push_back(light);
        light += has_many_lights ? 1 : 0;
    }
}

/// Adds a light and its surface to a scene without polygons that emit.
inline void add_round_light(scene::Scene& scene, scene::RoundLight light) {
    light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"round " + std::to_string(light.emitter)});
    add_surface(scene, surface(light, scene::kRoundSides),
                static_cast<std::int32_t>(scene.lights.of<scene::RoundLight>().size()), false);
    scene.lights.of<scene::RoundLight>().push_back(light);
}

/// Adds the same light as a polygon for each triangle of its surface. Where it shines outwards, they have its area.
inline void add_tessellated_light(scene::Scene& scene, const scene::RoundLight& light) {
    using namespace scene;
    LightSurface flat = surface(light, kRoundSides);
    add_surface(scene, flat, static_cast<std::int32_t>(scene.lights.of<PolygonLight>().size()), true);
    const Double3 center = to_double(light.center);
    double flat_area = 0;
    const auto corner = [&](const Triangle& triangle, int i) { return flat.positions[triangle.vertex[i]]; };
    for (const Triangle& triangle : flat.triangles) {
        const Double3 p = to_double(corner(triangle, 0));
        flat_area +=
            0.5 * length(cross(to_double(corner(triangle, 1)) - p, to_double(corner(triangle, 2)) - p));
    }
    const double factor =
        light.model == RoundModel::hollow || light.two_sided ? 1 : std::sqrt(area(light) / flat_area);
    for (Float3& p : flat.positions) p = to_float(center + factor * (to_double(p) - center));
    const auto emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"tessellated"});
    for (const Triangle& triangle : flat.triangles)
        scene.lights.of<PolygonLight>().push_back(
            {.emitter = emitter,
             .vertices = {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)},
             .radiance = light.radiance,
             .two_sided = light.two_sided});
}

/// A sphere that emits outwards, or inwards if its model is hollow. \param radius [m]
inline scene::RoundLight sphere(const Float3& center, float radius,
                                scene::RoundModel model = scene::RoundModel::ellipsoid) {
    return {.model = model,
            .center = center,
            .u = {radius, 0, 0},
            .v = {0, radius, 0},
            .w = {0, 0, radius},
            .radiance = {3, 2, 1}};
}

} // namespace nusselt::render_test
