#pragma once
/// The pixels of an image.

#include "scene/model/scene.h"

namespace nusselt::render {

/// The pixels of the film that an image of it has: the crop, or all.
scene::PixelBounds rendered_pixels(const scene::Film& film);

/// Gives the film another size in pixels as pbrt would: the centre of the view, the aspect ratio of pixels and what is
/// seen along the shorter axis stay. A crop keeps its share of the film: its ends are scaled and rounded to the nearest
/// pixel, so that neighbouring crops stay neighbours, but it keeps at least one pixel along each axis.
/// \throws std::invalid_argument unless both lie between 1 and scene::kMaxFilmSize
void resize_film(scene::Scene& scene, int width, int height);

/// Likewise, with the height that keeps the shape of the film up to rounding.
void resize_film_to_width(scene::Scene& scene, int width);

} // namespace nusselt::render
