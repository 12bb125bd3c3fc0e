#include "scene/import/pbrt/objects.h"

#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace nusselt::scene {

namespace {

bool emits(const ShapeDirective& shape) { return shape.type == "line" || !is_black(shape.emission.radiance); }

/// Roughly how many numbers describe a shape.
std::size_t value_count(const ShapeDirective& shape) {
    const std::uint64_t bytes = shape.mesh_path.empty() ? 0 : claimed_size(shape.mesh_path);
    return shape.parameters.value_count() + static_cast<std::size_t>(bytes / sizeof(float));
}

std::optional<std::array<float, 12>> affine_rows(const Transform& t) {
    const auto& last = t.m[3];
    if (last[0] != 0 || last[1] != 0 || last[2] != 0) return std::nullopt;
    std::array<float, 12> rows{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double entry = t.m[i / 4][i % 4] / last[3];
        if (!(std::fabs(entry) <= kMaxCoordinate)) return std::nullopt;
        rows[i] = static_cast<float>(entry);
    }
    return rows;
}

} // namespace

std::optional<std::array<float, 12>> instance_rows(const Transform& t) {
    const auto back = inverse(t);
    if (!back || !affine_rows(*back)) return std::nullopt;
    return affine_rows(t);
}

void ObjectTable::begin(const std::string& name, const Location& location, Warnings& warnings) {
    if (is_open_)
        throw SceneError(location, "ObjectBegin inside of the definition of object \"" +
                                       shortened(definitions_.back().name) + "\" begun at " +
                                       to_string(definitions_.back().location));
    if (by_name_.contains(name))
        warnings.add(location,
                     "object \"" + shortened(name) + "\" is defined again; the new one applies from here on");
    by_name_[name] = definitions_.size();
    definitions_.push_back({name, location, {}, {}, false});
    is_open_ = true;
}

void ObjectTable::add_instance(const std::string& name, const Transform& transform,
                               const Location& location) {
    if (is_open_)
        throw SceneError(location, "ObjectInstance inside of the definition of object \"" +
                                       shortened(definitions_.back().name) +
                                       "\": objects cannot contain instances");
    const auto found = by_name_.find(name);
    if (found == by_name_.end())
        throw SceneError(location, "object \"" + shortened(name) +
                                       "\" is not defined; ObjectBegin must come before its instances");
    if (!instance_rows(transform))
        throw SceneError(location, "ObjectInstance: the transform of object \"" + shortened(name) +
                                       "\" cannot be inverted or exceeds 1e15");
    definitions_[found->second].is_used = true;
    instances_.push_back({found->second, transform, location});
}

void ObjectTable::add_shape(ShapeDirective shape) {
    Definition& definition = definitions_.back();
    (emits(shape) ? definition.emitters : definition.surfaces).push_back(std::move(shape));
}

void ObjectTable::check_copies() const {
    std::vector<std::size_t> value_counts;
    for (const Definition& definition : definitions_) {
        const auto add = [](std::size_t sum, const ShapeDirective& shape) {
            return sum + value_count(shape);
        };
        value_counts.push_back(
            std::accumulate(definition.emitters.begin(), definition.emitters.end(), std::size_t{0}, add));
    }
    std::size_t copies = 0;
    std::size_t values = 0;
    for (const InstanceDirective& instance : instances_) {
        copies += definitions_[instance.object].emitters.size();
        values += value_counts[instance.object];
        if (copies > kMaxLightCopies || values > kMaxCopiedValues)
            throw SceneError(instance.location,
                             "instances have more than " + std::to_string(kMaxLightCopies) +
                                 " shapes that emit light, or more than " + std::to_string(kMaxCopiedValues) +
                                 " numbers in these; leave lights out of objects");
    }
}

std::vector<ObjectShapes> ObjectTable::append_shapes(std::vector<ShapeDirective>& shapes) {
    check_copies();
    for (const InstanceDirective& instance : instances_) {
        for (const ShapeDirective& shape : definitions_[instance.object].emitters) {
            ShapeDirective& copy = shapes.emplace_back(shape);
            copy.world_from_object = instance.world_from_object * shape.world_from_object;
        }
    }
    std::vector<ObjectShapes> objects;
    std::vector<std::size_t> new_index(definitions_.size());
    for (std::size_t i = 0; i < definitions_.size(); ++i) {
        Definition& definition = definitions_[i];
        if (!definition.is_used) continue;
        new_index[i] = objects.size();
        objects.push_back({definition.name, shapes.size(), definition.surfaces.size()});
        std::move(definition.surfaces.begin(), definition.surfaces.end(), std::back_inserter(shapes));
    }
    for (InstanceDirective& instance : instances_) instance.object = new_index[instance.object];
    return objects;
}

} // namespace nusselt::scene
