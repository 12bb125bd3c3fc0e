#pragma once
/// Change of the image size.

#include "scene/scene.h"

namespace nusselt::render_cpu {

inline constexpr int kMaxFilmSize = 65536; ///< pixels along an axis

/// Gives the film another size in pixels as pbrt would: the viewing direction, the aspect ratio of pixels and
/// the field of view of the shorter axis stay.
/// \throws std::invalid_argument unless both lie between 1 and kMaxFilmSize
void resize_film(scene::Scene& scene, int width, int height);

} // namespace nusselt::render_cpu
