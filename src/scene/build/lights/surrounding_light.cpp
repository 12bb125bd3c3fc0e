#include "scene/build/lights/surrounding_light.h"

#include "scene/model/lights/round/round_axes.h"

namespace nusselt::scene {

namespace {

/// Where the ray through the middle of the film starts.
Double3 eye(const Scene& scene) {
    const Camera& camera = scene.camera;
    return to_double(camera.origin) + (0.5 * scene.film.width) * to_double(camera.origin_right) +
           (0.5 * scene.film.height) * to_double(camera.origin_down);
}

/// Whether a round light has a surface without holes.
bool has_opaque_surface(const Scene& scene, std::size_t index) {
    for (std::size_t i = 0; i < scene.triangle_light.size(); ++i) {
        if (round_light_of(scene, i) != static_cast<std::int64_t>(index)) continue;
        const Material& material = scene.materials[scene.triangle_material[i]];
        return material.alpha >= 1 && material.alpha_texture.texture < 0;
    }
    return false;
}

} // namespace

bool surrounds_camera(const Scene& scene, const RoundLight& light) {
    if (light.model != RoundModel::ellipsoid || light.two_sided) return false;
    const Double3 p = RoundAxes(light).unit(eye(scene) - to_double(light.center));
    return dot(p, p) < 1;
}

Darkness darkness_inside(const Scene& scene, std::size_t index) {
    if (!surrounds_camera(scene, scene.lights.of<RoundLight>()[index]) || !has_opaque_surface(scene, index))
        return std::nullopt;
    return "the scene's camera is inside and sees none of its light, because it shines outwards; "
           "ReverseOrientation in a pbrt scene or \"inwards\": true in a light rig turns it";
}

void warn_of_surrounding_lights(const Scene& scene, Warnings& warnings) {
    const std::vector<RoundLight>& lights = scene.lights.of<RoundLight>();
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (const Darkness dark = darkness_inside(scene, i))
            warnings.add({}, scene.emitters[lights[i].emitter].name + ": " + *dark);
}

} // namespace nusselt::scene
