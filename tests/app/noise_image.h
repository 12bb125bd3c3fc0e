#pragma once

#include "image/image.h"

#include <random>

namespace nusselt {

/// Noise of the given width and height.
inline image::Image noise(int width, int height) {
    image::Image result = image::make_image(width, height);
    std::mt19937 engine(1);
    for (float& value : result.pixels) value = float(engine() % 1000) / 1000;
    return result;
}

} // namespace nusselt
