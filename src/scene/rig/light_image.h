#pragma once
/// Images that lights emit, and maps of environments, which rigs exchange.

#include "scene/rig/light_edit.h"
#include "scene/rig/rig.h"

#include <optional>
#include <string>

namespace nusselt::scene {

/// The path of the image that a light emits, or of the map of an environment; empty if it has none.
std::string image_path(const Scene& scene, const EditableLight& light);
std::string map_path(const Scene& scene, const EditableLight& light);

/// Gives a light another image or map. Without a scale, its power keeps the luminance, in the colours of the image. Polygons
/// show the same part of it as of the image before; a parallelogram without an image shows all of it, from its first vertex along
/// its first edge. Nothing changes if the light has this image already and no scale is given.
/// \returns what does not fit the light; nothing if all is well
std::optional<FieldDefect> change_image(const GivenImage& given, Scene& scene, EditableLight& light);

/// Makes channels of a light with an image or a map black that are darker than kDarkest.
/// \returns whether the light becomes black by that
bool drop_dark_channels(EditableLight& light);

/// Whether a texel of its images or maps makes a light brighter than kMaxRadiance.
bool has_too_bright_texels(const Scene& scene, const EditableLight& light);

/// Turns the map of an environment about the origin; its portal stays.
std::optional<FieldDefect> turn_map(const Rotation& rotation, EditableLight& light);

} // namespace nusselt::scene
