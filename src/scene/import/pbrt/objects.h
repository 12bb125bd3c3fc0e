#pragma once
/// Definitions and instances of objects while a scene file is parsed.

#include "scene/import/pbrt/shape_directive.h"

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace nusselt::scene {

class ObjectTable {
public:
    /// Shapes belong to this object from here on. Throws SceneError inside another definition.
    void begin(const std::string& name, const Location& location, Warnings& warnings);
    void end() { is_open_ = false; }
    bool is_open() const { return is_open_; }
    /// Adds a shape to the open definition.
    void add_shape(ShapeDirective shape) { definitions_.back().shapes.push_back(std::move(shape)); }

    /// Throws SceneError if no object has this name, if it is used inside a definition, or if `transform` has no
    /// inverse.
    void add_instance(const std::string& name, const Transform& transform, const Location& location,
                      const FormatWords& words);

    /// All definitions. Shapes of those without instances are not read: nobody sees them.
    std::vector<ObjectDescription> take_objects();
    std::vector<InstanceDescription> take_instances() { return std::move(instances_); }

private:
    struct Definition {
        std::string name;
        Location location;
        std::vector<ShapeDirective> shapes;
        bool is_used = false;
    };

    std::vector<Definition> definitions_;
    std::unordered_map<std::string, std::size_t> by_name_;
    std::vector<InstanceDescription> instances_;
    bool is_open_ = false;
};

} // namespace nusselt::scene
