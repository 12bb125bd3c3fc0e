#pragma once
/// A scene with all that surfaces can have.

#include "scene/model/profiles/luminaire.h"
#include "scene/model/scene.h"

#include <memory>

namespace nusselt::render_vulkan_test {

/// A room with panels, a tube and a line, textures of all wraps and filters, a bump map, a normal map, surfaces that are
/// partly there, and copies of an object, one of them mirrored.
scene::Scene make_rich_scene(int width, int height);

/// The same with all surfaces wholly there. Whether a shadow ray meets one that is not depends on all bits of the ray, which
/// both renderers round differently.
scene::Scene make_opaque_scene(int width, int height);

/// The opaque scene without textures and copies, for which drivers compile much faster.
scene::Scene make_plain_scene(int width, int height);

/// A luminaire without symmetry, whose half-planes are at uneven angles.
std::shared_ptr<const scene::Luminaire> make_luminaire();

/// The plain scene with a light of each kind without extent in place of its lights; images light it.
scene::Scene make_scene_of_light_sources(int width, int height);

} // namespace nusselt::render_vulkan_test
