#include "scene/build/build_scene.h"

#include "scene/build/build_shape.h"
#include "scene/build/parallel.h"
#include "scene/build/textures/surface_formula.h"
#include "scene/build/textures/texture_bake.h"
#include "scene/input/file_bytes.h"
#include "scene/model/bounds.h"
#include "scene/model/scene_size.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <tbb/parallel_for.h>
#include <unordered_map>
#include <utility>

namespace nusselt::scene {

namespace {

/// Limits the memory that files take which many shapes name: each shape has its own triangles.
void check_repeated_meshes(const std::vector<PlacedShape>& shapes, const FormatWords& words) {
    std::unordered_map<std::string, std::uint64_t> sizes;
    std::uint64_t repeated = 0;
    for (const PlacedShape& placed : shapes) {
        const MeshFile* const file = std::get_if<MeshFile>(&placed.shape->geometry);
        if (file == nullptr) continue;
        const auto [entry, is_new] = sizes.try_emplace(file->path.lexically_normal().string());
        if (is_new) {
            entry->second = claimed_size(file->path);
            continue;
        }
        repeated += entry->second;
        if (repeated > kMaxRepeatedMeshBytes)
            throw SceneError(file->origin, "repeated mesh files exceed " +
                                               std::to_string(kMaxRepeatedMeshBytes) +
                                               " bytes in total; the last one is '" + file->path.string() +
                                               "'; use " + words.instance + " for copies");
    }
}

std::vector<BuiltShape> build_shapes(const std::vector<PlacedShape>& shapes,
                                     const SceneDescription& description) {
    std::vector<BuiltShape> built(shapes.size());
    parallel_for_each_index(shapes.size(), [&](std::size_t i) {
        built[i] = build_shape(shapes[i], *description.budget, description.words);
    });
    return built;
}

/// Sets the coordinates at which materials look up their textures.
void set_mappings(const std::vector<BakedTexture>& textures, std::vector<Material>& materials) {
    for (Material& material : materials) {
        for (TextureUse* use : {&material.diffuse_texture, &material.f0_texture, &material.roughness_texture,
                                &material.alpha_texture, &material.bump_texture, &material.normal_texture}) {
            if (use->texture < 0) continue;
            const TextureMapping& mapping = textures[static_cast<std::size_t>(use->texture)].mapping;
            use->scale = {mapping.scale[0], mapping.scale[1]};
            use->offset = {mapping.offset[0], mapping.offset[1]};
        }
    }
}

/// Makes names such as "sphere at scene.pbrt:7", with the file relative to the folder of the scene, and without a line if
/// it has none. Numbers distinguish equal names.
class EmitterNames {
public:
    explicit EmitterNames(const std::filesystem::path& scene) : folder_(scene.parent_path()) {}

    std::string name(const ShapeDescription& shape) {
        const std::filesystem::path& path = shape.origin.file->path;
        const std::filesystem::path relative = path.lexically_relative(folder_);
        std::string name = shape.kind + " at " + (relative.empty() ? path : relative).string();
        if (shape.origin.line > 0) name += ":" + std::to_string(shape.origin.line);
        const std::size_t count = ++counts_[name];
        return count == 1 ? name : name + " #" + std::to_string(count);
    }

private:
    std::filesystem::path folder_;
    std::unordered_map<std::string, std::size_t> counts_;
};

void name_emitters(const std::vector<PlacedShape>& shapes, std::vector<BuiltShape>& built, EmitterNames names,
                   std::vector<Emitter>& emitters) {
    for (std::size_t i = 0; i < built.size(); ++i) {
        if (built[i].lights.empty()) continue;
        const auto emitter = static_cast<std::uint32_t>(emitters.size());
        for (LightList& list : built[i].lights)
            for (std::size_t k = 0; k < list.size(); ++k) list.emitter(k) = emitter;
        emitters.push_back({names.name(*shapes[i].shape)});
    }
}

/// Shifts the indices of each shape by the vertices and lights of the shapes before it.
void renumber(std::vector<BuiltShape>& shapes, const FormatWords& words) {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t lights = 0;
    for (BuiltShape& mesh : shapes) {
        const auto first_vertex = static_cast<std::uint32_t>(vertices);
        const auto first_light = static_cast<std::int32_t>(lights);
        vertices += mesh.positions.size();
        lights += std::as_const(mesh.lights).of<SurfaceLight>().size();
        triangles += mesh.triangles.size();
        check_counts(vertices, triangles, words.instance);
        if (first_vertex > 0)
            for (Triangle& triangle : mesh.triangles)
                for (std::uint32_t& vertex : triangle.vertex) vertex += first_vertex;
        if (first_light > 0)
            for (std::int32_t& light : mesh.triangle_light) light += first_light;
    }
}

/// Joins the arrays of the shapes to one of the scene, and releases them: large scenes fill the memory, so that little may
/// exist twice.
/// \param sizes    the number of elements of each shape in the scene
/// \param missing  the value of elements of shapes without this array
template <class T, class Owner>
std::vector<T> take_arrays(std::vector<BuiltShape>& shapes, std::vector<T> Owner::*array,
                           const std::vector<std::size_t>& sizes, const T& missing) {
    std::vector<std::size_t> offsets(shapes.size());
    std::exclusive_scan(sizes.begin(), sizes.end(), offsets.begin(), std::size_t{0});
    const std::size_t total = shapes.empty() ? 0 : offsets.back() + sizes.back();
    for (BuiltShape& shape : shapes)
        if ((shape.*array).size() == total) return std::exchange(shape.*array, {});
    std::vector<T> result(total, missing);
    tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) {
        const std::vector<T> part = std::exchange(shapes[i].*array, {});
        std::copy(part.begin(), part.end(), result.begin() + static_cast<std::ptrdiff_t>(offsets[i]));
    });
    return result;
}

template <class T, class Owner>
std::vector<std::size_t> sizes_of(const std::vector<BuiltShape>& shapes, std::vector<T> Owner::*array) {
    std::vector<std::size_t> sizes;
    for (const BuiltShape& shape : shapes) sizes.push_back((shape.*array).size());
    return sizes;
}

/// The material of the triangles of each shape. Adds a black material that surfaces without one share.
std::vector<std::uint32_t> material_indices(const std::vector<PlacedShape>& shapes,
                                            const std::vector<std::size_t>& triangle_counts,
                                            std::vector<Material>& materials) {
    std::optional<std::uint32_t> black;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const int material = shapes[i].shape->material;
        if (material == kNoMaterial && triangle_counts[i] > 0 && !black) {
            black = static_cast<std::uint32_t>(materials.size());
            materials.push_back(black_material());
        }
        indices.push_back(material == kNoMaterial ? black.value_or(0) : static_cast<std::uint32_t>(material));
    }
    return indices;
}

void join_shapes(const std::vector<PlacedShape>& shapes, const FormatWords& words,
                 std::vector<BuiltShape>& built, Scene& scene) {
    renumber(built, words);
    const std::vector<std::size_t> vertices = sizes_of(built, &BuiltShape::positions);
    const std::vector<std::size_t> triangles = sizes_of(built, &BuiltShape::triangles);
    scene.positions = take_arrays(built, &BuiltShape::positions, vertices, {});
    scene.normals = take_arrays(built, &BuiltShape::normals, vertices, {0, 0, 0});
    scene.uvs = take_arrays(built, &BuiltShape::uvs, vertices, {0, 0});
    scene.triangles = take_arrays(built, &BuiltShape::triangles, triangles, {});
    scene.triangle_light = take_arrays(built, &BuiltShape::triangle_light, triangles, -1);
    scene.triangle_material.reserve(scene.triangles.size());
    const std::vector<std::uint32_t> materials = material_indices(shapes, triangles, scene.materials);
    for (std::size_t i = 0; i < built.size(); ++i)
        scene.triangle_material.insert(scene.triangle_material.end(), triangles[i], materials[i]);
    for (BuiltShape& shape : built) scene.lights.append(std::move(shape.lights));
}

/// Adds the objects that have triangles, and their instances.
/// \param triangle_counts  for each shape
void add_instances(const SceneDescription& description, const std::vector<PlacedObject>& objects,
                   const std::vector<std::size_t>& triangle_counts, Scene& scene) {
    std::vector<std::size_t> first_triangle(triangle_counts.size() + 1);
    std::partial_sum(triangle_counts.begin(), triangle_counts.end(), first_triangle.begin() + 1);
    std::vector<std::optional<std::uint32_t>> new_index(objects.size());
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const std::size_t first = first_triangle[objects[i].first_shape];
        const std::size_t count = first_triangle[objects[i].first_shape + objects[i].shape_count] - first;
        if (count == 0) continue;
        new_index[i] = static_cast<std::uint32_t>(scene.objects.size());
        scene.objects.push_back({description.objects[i].name, static_cast<std::uint32_t>(first),
                                 static_cast<std::uint32_t>(count)});
        boxes.push_back(triangle_bounds(scene, first, count));
    }
    for (const InstanceDescription& instance : description.instances) {
        const std::string& name = description.objects[instance.object].name;
        const std::array<float, 12> rows = instance_rows(instance, name, description.words);
        const std::optional<std::uint32_t> object = new_index[instance.object];
        if (!object) continue;
        const Bounds box = transformed(boxes[*object], rows);
        if (!is_valid_coordinate(to_float(box.low)) || !is_valid_coordinate(to_float(box.high)))
            throw SceneError(instance.origin, description.words.instance + ": object \"" + shortened(name) +
                                                  "\" extends beyond 1e15 m");
        scene.instances.push_back({*object, rows});
    }
}

void collect_warnings(const std::vector<PlacedShape>& shapes, const std::vector<BuiltShape>& built,
                      Warnings& warnings) {
    std::size_t degenerate = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < built.size(); ++i) {
        warnings.append(built[i].warnings);
        if (degenerate == 0) first = i;
        degenerate += built[i].degenerate_triangles;
    }
    if (degenerate > 0)
        warnings.add(shapes[first].shape->origin,
                     std::to_string(degenerate) + " degenerate triangles are skipped, starting here");
}

} // namespace

Scene build_scene(SceneDescription description) {
    Scene scene;
    scene.materials = std::move(description.materials);
    scene.film = description.film;
    PlacedShapes placed = place_shapes(description);
    scene.camera = make_camera(description.camera, description.film);
    limit_tessellation(placed.shapes);
    check_repeated_meshes(placed.shapes, description.words);
    std::vector<BuiltShape> built;
    std::vector<BakedTexture> textures;
    Warnings texture_warnings;
    parallel_for_each_index(2, [&](std::size_t part) {
        if (part == 0)
            built = build_shapes(placed.shapes, description);
        else
            textures = bake_textures(description.textures, *description.budget, texture_warnings);
    });
    description.warnings.append(texture_warnings);
    set_mappings(textures, scene.materials);
    for (BakedTexture& texture : textures) scene.textures.push_back(std::move(texture.texture));
    name_emitters(placed.shapes, built, EmitterNames(description.sources.front().path), scene.emitters);
    const std::vector<std::size_t> triangle_counts = sizes_of(built, &BuiltShape::triangles);
    join_shapes(placed.shapes, description.words, built, scene);
    add_instances(description, placed.objects, triangle_counts, scene);
    collect_warnings(placed.shapes, built, description.warnings);
    if (scene.triangles.empty() && scene.lights.empty())
        description.warnings.add({&description.sources.front(), 1}, "the scene is empty");
    scene.radius = scene_radius(scene);
    scene.warnings = description.warnings.lines();
    return scene;
}

} // namespace nusselt::scene
