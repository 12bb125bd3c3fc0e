#pragma once
/// Finds the light at a place of the image, and lets it follow the mouse.

#include "fly_camera.h"
#include "light_edits.h"

#include "scene/model/scene.h"

#include <cstddef>
#include <optional>

namespace nusselt::viewer {

/// A position in the film [pixels], y downwards.
struct FilmPosition {
    double x = 0, y = 0;
};

/// The nearest light that is seen there, were there no surfaces: the index in Scene::emitters. Lights that are switched
/// off cannot be hit, thin tubes within a few pixels.
std::optional<std::size_t> light_at(const scene::Scene& loaded, const LightEdits& edits,
                                    const scene::Camera& camera, FilmPosition position);

/// The motion of a light whose centroid follows the mouse, in a plane parallel to the image [m]. Zero if the
/// centroid is behind the camera.
scene::Double3 drag_of(const scene::Scene& loaded, const LightEdits& edits, std::size_t light,
                       const scene::Camera& camera, FilmPosition from, FilmPosition to);

} // namespace nusselt::viewer
