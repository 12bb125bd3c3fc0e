#include "scene/build/placed_shape.h"

#include "scene/build/build_shape.h"
#include "scene/build/tessellate.h"
#include "scene/input/file_bytes.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>

namespace nusselt::scene {

namespace {

/// Whether a shape is a light. Lights belong to the world: instances copy them.
bool is_light(const ShapeDescription& shape) {
    return !is_black(shape.emission.radiance) ||
           !becomes_surface(shape.geometry, shape.emission, shape.world_from_object);
}

std::size_t array_values(const std::vector<Float3>& positions, const std::vector<Float3>& normals,
                         const std::vector<Float2>& uvs) {
    return 3 * positions.size() + 3 * normals.size() + 2 * uvs.size();
}

/// Roughly how many numbers describe a shape.
struct ValueCount {
    std::size_t operator()(const Mesh& mesh) const {
        return array_values(mesh.positions, mesh.normals, mesh.uvs) + 3 * mesh.triangles.size();
    }
    std::size_t operator()(const MeshFile& file) const {
        return static_cast<std::size_t>(claimed_size(file.path) / sizeof(float));
    }
    std::size_t operator()(const BilinearPatches& patches) const {
        return array_values(patches.positions, patches.normals, patches.uvs) + patches.indices.size();
    }
    std::size_t operator()(const Sphere&) const { return 4; }
    std::size_t operator()(const Disk&) const { return 4; }
    std::size_t operator()(const Cylinder&) const { return 4; }
    std::size_t operator()(const Tube&) const { return 7; }
};

/// Limits the copies of lights: those of instances are copied, because lights belong to the world.
void check_copies(const SceneDescription& description) {
    std::vector<std::size_t> emitters;
    std::vector<std::size_t> value_counts;
    for (const ObjectDescription& object : description.objects) {
        std::size_t count = 0;
        std::size_t values = 0;
        for (const ShapeDescription& shape : object.shapes) {
            if (!is_light(shape)) continue;
            ++count;
            values += std::visit(ValueCount(), shape.geometry);
        }
        emitters.push_back(count);
        value_counts.push_back(values);
    }
    std::size_t copies = 0;
    std::size_t values = 0;
    for (const InstanceDescription& instance : description.instances) {
        copies += emitters[instance.object];
        values += value_counts[instance.object];
        if (copies > kMaxLightCopies || values > kMaxCopiedValues)
            throw SceneError(instance.origin, "instances have more than " + std::to_string(kMaxLightCopies) +
                                                  " shapes that emit light, or more than " +
                                                  std::to_string(kMaxCopiedValues) +
                                                  " numbers in these; move lights out of objects");
    }
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

std::array<float, 12> instance_rows(const InstanceDescription& instance, std::string_view object,
                                    const FormatWords& words) {
    const auto rows = instance_rows(instance.world_from_object);
    if (!rows)
        throw SceneError(instance.origin, words.instance + ": the transform of object \"" +
                                              shortened(object) + "\" is not invertible or exceeds 1e15");
    return *rows;
}

bool is_round(const Geometry& geometry) {
    return std::holds_alternative<Sphere>(geometry) || std::holds_alternative<Disk>(geometry) ||
           std::holds_alternative<Cylinder>(geometry) || std::holds_alternative<BilinearPatches>(geometry);
}

bool can_be_built_alone(const ShapeDescription& shape) {
    const auto* const patches = std::get_if<BilinearPatches>(&shape.geometry);
    return std::holds_alternative<Mesh>(shape.geometry) || (patches != nullptr && are_planar(*patches)) ||
           !becomes_surface(shape.geometry, shape.emission, shape.world_from_object);
}

PlacedShapes place_shapes(SceneDescription& description) {
    check_copies(description);
    PlacedShapes placed;
    for (WorldPart& part : description.world) {
        if (auto* const built = std::get_if<BuiltShape>(&part)) {
            placed.shapes.push_back({nullptr, {}, false, built});
        } else {
            ShapeDescription& shape = std::get<ShapeDescription>(part);
            placed.shapes.push_back({&shape, shape.world_from_object});
        }
    }
    std::vector<bool> has_instance(description.objects.size());
    for (const InstanceDescription& instance : description.instances) {
        has_instance[instance.object] = true;
        for (ShapeDescription& shape : description.objects[instance.object].shapes)
            if (is_light(shape))
                placed.shapes.push_back({&shape, instance.world_from_object * shape.world_from_object, true});
    }
    for (std::size_t i = 0; i < description.objects.size(); ++i) {
        PlacedObject& object = placed.objects.emplace_back();
        object.first_shape = placed.shapes.size();
        if (!has_instance[i]) continue;
        for (ShapeDescription& shape : description.objects[i].shapes)
            if (!is_light(shape)) placed.shapes.push_back({&shape, shape.world_from_object});
        object.shape_count = placed.shapes.size() - object.first_shape;
    }
    return placed;
}

void limit_tessellation(std::vector<PlacedShape>& shapes) {
    constexpr double kFineShapes = 1000; // so many may have all sides
    constexpr int kFewest = 8;
    std::size_t round_shapes = 0;
    for (const PlacedShape& placed : shapes) {
        if (placed.built != nullptr)
            round_shapes += placed.built->round_shapes;
        else if (is_round(placed.shape->geometry))
            ++round_shapes;
    }
    const auto count = static_cast<double>(round_shapes);
    if (count <= kFineShapes) return;
    for (PlacedShape& placed : shapes)
        placed.max_sides =
            std::max(kFewest, static_cast<int>(placed.max_sides * std::sqrt(kFineShapes / count)));
}

} // namespace nusselt::scene
