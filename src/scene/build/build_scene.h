#pragma once
/// The builder: from what importers describe to the model that renderers consume.

#include "scene/build/scene_description.h"
#include "scene/model/scene.h"

namespace nusselt::scene {

/// Reads the meshes and images that are still missing, tessellates round shapes, merges the triangles of lights to polygons,
/// copies lights of instances to the world, names lights, leaves out degenerate triangles, and bakes textures.
/// Throws SceneError at the origin of what cannot be built or exceeds the limits.
Scene build_scene(SceneDescription description);

} // namespace nusselt::scene
