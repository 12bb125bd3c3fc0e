#include "render_cpu/film.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace nusselt::render_cpu {

namespace {

scene::Float3 scaled(double factor, const scene::Float3& v) {
    return {static_cast<float>(factor * v.x), static_cast<float>(factor * v.y),
            static_cast<float>(factor * v.z)};
}

} // namespace

void resize_film(scene::Scene& scene, int width, int height) {
    for (const int size : {width, height})
        if (size < 1 || size > kMaxFilmSize)
            throw std::invalid_argument("image sizes lie between 1 and " + std::to_string(kMaxFilmSize) +
                                        ", found " + std::to_string(size));
    const scene::Film& film = scene.film;
    scene::Camera& camera = scene.camera;
    const double scale = static_cast<double>(std::min(film.width, film.height)) / std::min(width, height);
    const auto corner = [&](float corner_entry, float right, float down) {
        const double center = corner_entry + 0.5 * film.width * right + 0.5 * film.height * down;
        return static_cast<float>(center - scale * (0.5 * width * right + 0.5 * height * down));
    };
    camera.corner = {corner(camera.corner.x, camera.right.x, camera.down.x),
                     corner(camera.corner.y, camera.right.y, camera.down.y),
                     corner(camera.corner.z, camera.right.z, camera.down.z)};
    camera.right = scaled(scale, camera.right);
    camera.down = scaled(scale, camera.down);
    scene.film.width = width;
    scene.film.height = height;
}

} // namespace nusselt::render_cpu
