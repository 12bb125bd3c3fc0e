#pragma once
/// Portals that let no light through to any surface.

#include "scene/build/built_shape.h"
#include "scene/input/diagnostics.h"
#include "scene/model/scene.h"

#include <vector>

namespace nusselt::scene {

/// Where the environments of a scene come from, in their order.
std::vector<Location> environment_origins(const BuiltShape& shapes);

/// Warns of each portal through which no surface receives light, because the map is black on one side of its plane, and all
/// surfaces are on the other side or in the plane. Whether something hides a portal does not count.
/// \param origins of the environments of the scene
void warn_of_dark_portals(const Scene& scene, const std::vector<Location>& origins, Warnings& warnings);

} // namespace nusselt::scene
