#include "scene/import/pbrt/objects.h"

#include "scene/build/placed_shape.h"

namespace nusselt::scene {

void ObjectTable::begin(const std::string& name, const Location& location, Warnings& warnings) {
    if (is_open_)
        throw SceneError(location, "ObjectBegin inside the definition of object \"" +
                                       shortened(definitions_.back().name) + "\" that begins at " +
                                       to_string(definitions_.back().location));
    if (by_name_.contains(name))
        warnings.add(location,
                     "object \"" + shortened(name) + "\" is defined again; the new one applies from here on");
    by_name_[name] = definitions_.size();
    definitions_.push_back({name, location, {}, false});
    is_open_ = true;
}

void ObjectTable::add_instance(const std::string& name, const Transform& transform, const Location& location,
                               const FormatWords& words) {
    if (is_open_)
        throw SceneError(location, "ObjectInstance inside the definition of object \"" +
                                       shortened(definitions_.back().name) +
                                       "\": objects cannot contain instances");
    const auto found = by_name_.find(name);
    if (found == by_name_.end())
        throw SceneError(location, "object \"" + shortened(name) +
                                       "\" is not defined; ObjectBegin must come before its instances");
    instances_.push_back({found->second, transform, location});
    const InstanceDescription& instance = instances_.back();
    // The builder checks it too, but errors should come in the order of the file.
    instance_rows(instance, name, words);
    definitions_[instance.object].is_used = true;
}

std::vector<ObjectDescription> ObjectTable::take_objects() {
    std::vector<ObjectDescription> objects;
    for (Definition& definition : definitions_) {
        ObjectDescription& object = objects.emplace_back();
        object.name = std::move(definition.name);
        if (!definition.is_used) continue;
        for (ShapeDirective& shape : definition.shapes) {
            object.shapes.push_back(read_shape(shape));
            shape.parameters = {};
        }
    }
    return objects;
}

} // namespace nusselt::scene
