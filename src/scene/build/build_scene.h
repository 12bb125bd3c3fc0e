#pragma once
/// The builder turns the descriptions of importers into the model that renderers consume.

#include "scene/build/scene_description.h"
#include "scene/model/scene.h"

namespace nusselt::scene {

/// Reads meshes and images in files of their own, tessellates round shapes, merges the triangles of lights into polygons,
/// copies lights of instances to the world, names lights, leaves out degenerate triangles, and bakes textures.
/// Throws SceneError at the origin of a part that cannot be built or exceeds the limits.
Scene build_scene(SceneDescription description);

} // namespace nusselt::scene
