#pragma once
/// Finds the light at a place of the image, and the place of a point in the image.

#include "light_edits.h"

#include "scene/model/lights/light_geometry.h"
#include "scene/model/scene.h"

#include <cstddef>
#include <optional>
#include <utility>

namespace nusselt::viewer {

/// A position in the film [pixels], y downwards.
struct FilmPosition {
    double x = 0, y = 0;
};

scene::SightRay ray_through(const scene::Camera& camera, FilmPosition at);

/// Where the camera sees a point; nothing behind the camera.
std::optional<FilmPosition> seen_at(const scene::Camera& camera, const scene::Double3& point);
/// The part of a line in front of the camera; nothing if there is none.
std::optional<std::pair<FilmPosition, FilmPosition>>
seen_line(const scene::Camera& camera, const scene::Double3& begin, const scene::Double3& end);

/// The nearest light that is seen there, were there no surfaces: its index in LightEdits. Lights that are switched
/// off cannot be hit, thin tubes within a few pixels.
std::optional<std::size_t> light_at(const scene::Scene& loaded, const LightEdits& edits,
                                    const scene::Camera& camera, FilmPosition position);

/// The motion of a light whose centroid follows the mouse, in a plane parallel to the image [m]. Zero if the
/// centroid is behind the camera.
scene::Double3 drag_of(const scene::Double3& center, const scene::Camera& camera, FilmPosition from,
                       FilmPosition to);

} // namespace nusselt::viewer
