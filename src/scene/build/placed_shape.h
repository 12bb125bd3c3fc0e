#pragma once
/// The places of shapes: in the world or in objects, once or once per instance.

#include "scene/build/scene_description.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// A shape at one of its places.
struct PlacedShape {
    ShapeDescription* shape = nullptr;
    Transform world_from_object; ///< of a surface of an object: to the coordinates of that object
    bool is_shared = false;      ///< whether its geometry is needed elsewhere, too
    int max_sides = 0;           ///< pieces around the full circle of round shapes, at most
};

/// The surfaces of an object: a range of placed shapes.
struct PlacedObject {
    std::size_t first_shape = 0;
    std::size_t shape_count = 0;
};

struct PlacedShapes {
    /// The shapes of the world, then copies of all shapes of instances that emit light, moved to the world, then the
    /// other shapes of the objects that have instances.
    std::vector<PlacedShape> shapes;
    std::vector<PlacedObject>
        objects; ///< for each object of the description; without shapes where it has no instance
};

/// The result refers to the shapes of `description`. Throws SceneError if instances copy too many lights.
PlacedShapes place_shapes(SceneDescription& description);

/// Makes round shapes coarser if there are many, so that they fit into the memory: a line of text must not take much more
/// than it would as a mesh.
void limit_tessellation(std::vector<PlacedShape>& shapes);

/// The rows of an affine transform as instances have them. Nothing if it has no inverse, is not affine, or has
/// elements beyond 1e15, which ray tracing cannot bear, in itself or its inverse.
std::optional<std::array<float, 12>> instance_rows(const Transform& t);

/// The same for an instance of the object of this name. Throws SceneError where there are none.
std::array<float, 12> instance_rows(const InstanceDescription& instance, std::string_view object,
                                    const FormatWords& words);

} // namespace nusselt::scene
