#pragma once
/// Places shapes: in the world or in objects, once or once per instance.

#include "scene/build/scene_description.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// The most pieces around the full circle of a round shape in a scene with few of them.
inline constexpr int kMostSides = 64;

/// A shape at one of its places.
struct PlacedShape {
    ShapeDescription* shape = nullptr; ///< null for shapes that are built already
    Transform world_from_object;       ///< for a surface of an object: to the coordinates of that object
    bool is_shared = false;            ///< whether other places need its geometry, too
    BuiltShape* built = nullptr;       ///< null for shapes that are not
    int max_sides = kMostSides;        ///< the most pieces around the full circle of round shapes
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
        objects; ///< one for each object of the description, without shapes if it has no instance
};

/// The result refers to the shapes of `description`. Throws SceneError if instances copy too many lights.
PlacedShapes place_shapes(SceneDescription& description);

/// Whether the number of pieces of such a shape may depend on that of other shapes, see limit_tessellation().
bool is_round(const Geometry& geometry);

/// Whether the result of build_shape() is the same in every scene, and needs no other file.
bool can_be_built_alone(const ShapeDescription& shape);

/// Makes round shapes coarser in scenes with many of them, so that they fit into the memory: a line of text must not take
/// much more than it would as a mesh.
void limit_tessellation(std::vector<PlacedShape>& shapes);

/// The rows of an affine transform in the form of Instance. Empty if the transform has no inverse or is not affine, or if
/// one of both has elements beyond 1e15, which ray tracing does not support.
std::optional<std::array<float, 12>> instance_rows(const Transform& t);

/// The rows for an instance of the object of this name. Throws SceneError in the cases above.
std::array<float, 12> instance_rows(const InstanceDescription& instance, std::string_view object,
                                    const FormatWords& words);

} // namespace nusselt::scene
