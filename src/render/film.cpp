#include "render/film.h"

#include "scene/model/limits.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace nusselt::render {

namespace {

struct Size {
    int width, height;
};

/// Three vectors of a camera for another size of the film: corner + x * right + y * down in pixels.
void resize(scene::Float3& corner, scene::Float3& right, scene::Float3& down, const Size& from,
            const Size& to) {
    const double scale =
        static_cast<double>(std::min(from.width, from.height)) / std::min(to.width, to.height);
    for (float scene::Float3::*const axis : {&scene::Float3::x, &scene::Float3::y, &scene::Float3::z}) {
        const double center = corner.*axis + 0.5 * from.width * right.*axis + 0.5 * from.height * down.*axis;
        corner.*axis = static_cast<float>(
            center - scale * (0.5 * to.width * right.*axis + 0.5 * to.height * down.*axis));
        right.*axis = static_cast<float>(scale * right.*axis);
        down.*axis = static_cast<float>(scale * down.*axis);
    }
}

/// Scales one axis of a crop.
void resize(int& begin, int& end, int from, int to) {
    const auto resized = [&](int pixel) {
        return static_cast<int>(std::lround(static_cast<double>(pixel) * to / from));
    };
    begin = std::min(resized(begin), to - 1);
    end = std::max(resized(end), begin + 1);
}

} // namespace

scene::PixelBounds rendered_pixels(const scene::Film& film) {
    return film.crop.value_or(scene::PixelBounds{0, 0, film.width, film.height});
}

void resize_film(scene::Scene& scene, int width, int height) {
    for (const int size : {width, height})
        if (size < 1 || size > scene::kMaxFilmSize)
            throw std::invalid_argument("image sizes must lie between 1 and " +
                                        std::to_string(scene::kMaxFilmSize) + ", found " +
                                        std::to_string(size));
    const Size from = {scene.film.width, scene.film.height};
    const Size to = {width, height};
    scene::Camera& camera = scene.camera;
    resize(camera.origin, camera.origin_right, camera.origin_down, from, to);
    resize(camera.corner, camera.right, camera.down, from, to);
    if (std::optional<scene::PixelBounds>& crop = scene.film.crop) {
        resize(crop->x_begin, crop->x_end, from.width, to.width);
        resize(crop->y_begin, crop->y_end, from.height, to.height);
    }
    scene.film.width = width;
    scene.film.height = height;
}

void resize_film_to_width(scene::Scene& scene, int width) {
    const double height = static_cast<double>(scene.film.height) * width / scene.film.width;
    resize_film(scene, width, std::max(1, static_cast<int>(std::lround(height))));
}

} // namespace nusselt::render
