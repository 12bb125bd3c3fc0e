#pragma once
/// Why lights emit nothing although their colour is not black: an image, a map, a profile or a spread is to blame, or a portal
/// (dark_portals.h). Scenes and light rigs say it in the same words.

#include "scene/build/build_shape.h"
#include "scene/input/diagnostics.h"
#include "scene/model/profiles/luminaire.h"
#include "scene/model/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace nusselt::scene {

/// A clause that follows the name of a light and a colon; nothing if light leaves.
using Darkness = std::optional<std::string>;

/// The clause for lights that show nothing but black of an image or a map.
std::string black_image(std::string_view name);

/// Of a point light with this luminaire.
Darkness darkness(const Luminaire& luminaire);
/// Of a polygon, tube or line.
Darkness darkness(const ProfiledEmission& emission);
/// Why none of these lights emits anything, whatever their emission; portals do not count.
/// \param parts with indices into the arrays of the scene
Darkness darkness(const Scene& scene, const Lights& parts);

/// \param subject the name of the light
void warn_of_darkness(const Location& origin, const std::string& subject, const std::string& clause,
                      Warnings& warnings);

/// Turns the lights of a shape into surfaces that emit nothing, with a warning.
void make_dark(const ShapeDescription& shape, const std::string& clause, BuiltShape& built);

} // namespace nusselt::scene
