#pragma once
/// Definitions and instances of objects while a scene file is parsed.

#include "scene/import/pbrt/shapes.h"

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace nusselt::scene {

/// A range of shape directives, which define an object.
struct ObjectShapes {
    std::string name;
    std::size_t first_shape = 0;
    std::size_t shape_count = 0;
};

struct InstanceDirective {
    std::size_t object = 0; ///< index of its definition
    Transform world_from_object;
    Location location;
};

class ObjectTable {
public:
    /// Shapes belong to this object from here on. Throws SceneError inside of another definition.
    void begin(const std::string& name, const Location& location, Warnings& warnings);
    void end() { is_open_ = false; }
    bool is_open() const { return is_open_; }
    /// To the definition that is open.
    void add_shape(ShapeDirective shape);

    /// Throws SceneError if no object has this name, if it is used inside of a definition, or if `transform` has no
    /// inverse.
    void add_instance(const std::string& name, const Transform& transform, const Location& location);

    /// Appends to `shapes`, which have those of the world: copies of all shapes of instances that emit light, moved to
    /// the world, then the other shapes of the objects that have instances. Instances refer to the result afterwards,
    /// the first shape of which has the index shapes.size() of before. Throws SceneError if there are too many copies.
    std::vector<ObjectShapes> append_shapes(std::vector<ShapeDirective>& shapes);
    std::vector<InstanceDirective> take_instances() { return std::move(instances_); }

private:
    struct Definition {
        std::string name;
        Location location;
        std::vector<ShapeDirective> surfaces; ///< that do not emit
        std::vector<ShapeDirective> emitters;
        bool is_used = false;
    };
    void check_copies() const;

    std::vector<Definition> definitions_;
    std::unordered_map<std::string, std::size_t> by_name_;
    std::vector<InstanceDirective> instances_;
    bool is_open_ = false;
};

/// The rows of an affine transform as instances have them. Nothing if it has no inverse, is not affine, or has
/// elements beyond 1e15, which ray tracing cannot bear, in itself or its inverse.
std::optional<std::array<float, 12>> instance_rows(const Transform& t);

} // namespace nusselt::scene
