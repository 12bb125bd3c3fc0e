#include "scene/import/importers.h"

#include "scene/import/pbrt/parser.h"
#include "scene/model/bounds.h"
#include "scene/model/scene_size.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <unordered_map>
#include <utility>

namespace nusselt::scene {

namespace {

/// Each shape has triangles of its own, so that files which are named often multiply in memory.
void check_repeated_meshes(const std::vector<ShapeDirective>& shapes) {
    std::unordered_map<std::string, std::uint64_t> sizes;
    std::uint64_t repeated = 0;
    for (const ShapeDirective& shape : shapes) {
        if (shape.mesh_path.empty()) continue;
        const auto [entry, is_new] = sizes.try_emplace(shape.mesh_path.lexically_normal().string());
        if (is_new) {
            entry->second = claimed_size(shape.mesh_path);
            continue;
        }
        repeated += entry->second;
        if (repeated > kMaxRepeatedMeshBytes)
            throw SceneError(shape.parameters.location_of("filename"),
                             "mesh files are read again for more than " +
                                 std::to_string(kMaxRepeatedMeshBytes) + " bytes in all, the last one is '" +
                                 shape.mesh_path.string() + "'; use ObjectInstance for copies");
    }
}

std::vector<Mesh> build_meshes(std::vector<ShapeDirective>& shapes) {
    std::vector<Mesh> meshes(shapes.size());
    tbb::parallel_for(std::size_t{0}, shapes.size(),
                      [&](std::size_t i) { meshes[i] = build_mesh(shapes[i]); });
    return meshes;
}

/// Tells materials the coordinates at which their textures are looked up.
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

/// "sphere at scene.pbrt:7", the file relative to the folder of the scene. Shapes of equal names get numbers.
class EmitterNames {
public:
    explicit EmitterNames(const std::filesystem::path& scene) : folder_(scene.parent_path()) {}

    std::string name(const ShapeDirective& shape) {
        const Location& location = shape.parameters.location();
        const std::filesystem::path relative = location.file->path.lexically_relative(folder_);
        const std::string file = relative.empty() ? location.file->path.string() : relative.string();
        const std::string name = shape.type + " at " + file + ":" + std::to_string(location.line);
        const std::size_t count = ++counts_[name];
        return count == 1 ? name : name + " #" + std::to_string(count);
    }

private:
    std::filesystem::path folder_;
    std::unordered_map<std::string, std::size_t> counts_;
};

void name_emitters(const std::vector<ShapeDirective>& shapes, std::vector<Mesh>& meshes, EmitterNames names,
                   std::vector<Emitter>& emitters) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (meshes[i].polygon_lights.empty() && meshes[i].line_lights.empty()) continue;
        const auto emitter = static_cast<std::uint32_t>(emitters.size());
        for (PolygonLight& light : meshes[i].polygon_lights) light.emitter = emitter;
        for (LineLight& light : meshes[i].line_lights) light.emitter = emitter;
        emitters.push_back({names.name(shapes[i])});
    }
}

/// Shifts what triangles refer to by what other meshes have before them.
void renumber(std::vector<Mesh>& meshes) {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t lights = 0;
    for (Mesh& mesh : meshes) {
        const auto first_vertex = static_cast<std::uint32_t>(vertices);
        const auto first_light = static_cast<std::int32_t>(lights);
        vertices += mesh.positions.size();
        lights += mesh.polygon_lights.size();
        triangles += mesh.triangles.size();
        check_counts(vertices, triangles);
        if (first_vertex > 0)
            for (Triangle& triangle : mesh.triangles)
                for (std::uint32_t& vertex : triangle.vertex) vertex += first_vertex;
        if (first_light > 0)
            for (std::int32_t& light : mesh.triangle_light) light += first_light;
    }
}

/// One array of the scene from those of the meshes, which are released: scenes fill the memory, so that there must be
/// little that exists twice.
/// \param sizes    how many elements each mesh has in the scene
/// \param missing  value of the elements of meshes without this array
template <class T>
std::vector<T> take_arrays(std::vector<Mesh>& meshes, std::vector<T> Mesh::*array,
                           const std::vector<std::size_t>& sizes, const T& missing) {
    std::vector<std::size_t> offsets(meshes.size());
    std::exclusive_scan(sizes.begin(), sizes.end(), offsets.begin(), std::size_t{0});
    const std::size_t total = meshes.empty() ? 0 : offsets.back() + sizes.back();
    for (Mesh& mesh : meshes)
        if ((mesh.*array).size() == total) return std::exchange(mesh.*array, {});
    std::vector<T> result(total, missing);
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t i) {
        const std::vector<T> part = std::exchange(meshes[i].*array, {});
        std::copy(part.begin(), part.end(), result.begin() + static_cast<std::ptrdiff_t>(offsets[i]));
    });
    return result;
}

template <class T>
std::vector<std::size_t> sizes_of(const std::vector<Mesh>& meshes, std::vector<T> Mesh::*array) {
    std::vector<std::size_t> sizes;
    for (const Mesh& mesh : meshes) sizes.push_back((mesh.*array).size());
    return sizes;
}

void join_meshes(const std::vector<ShapeDirective>& shapes, std::vector<Mesh>& meshes, Scene& scene) {
    renumber(meshes);
    const std::vector<std::size_t> vertices = sizes_of(meshes, &Mesh::positions);
    const std::vector<std::size_t> triangles = sizes_of(meshes, &Mesh::triangles);
    scene.positions = take_arrays(meshes, &Mesh::positions, vertices, {});
    scene.normals = take_arrays(meshes, &Mesh::normals, vertices, {0, 0, 0});
    scene.uvs = take_arrays(meshes, &Mesh::uvs, vertices, {0, 0});
    scene.triangles = take_arrays(meshes, &Mesh::triangles, triangles, {});
    scene.triangle_light = take_arrays(meshes, &Mesh::triangle_light, triangles, -1);
    scene.triangle_material.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < meshes.size(); ++i)
        scene.triangle_material.insert(scene.triangle_material.end(), triangles[i],
                                       static_cast<std::uint32_t>(shapes[i].material));
    scene.polygon_lights =
        take_arrays(meshes, &Mesh::polygon_lights, sizes_of(meshes, &Mesh::polygon_lights), {});
    scene.line_lights = take_arrays(meshes, &Mesh::line_lights, sizes_of(meshes, &Mesh::line_lights), {});
}

/// The objects that have triangles, and their instances.
/// \param triangle_counts  of all shapes
void add_instances(const SceneDescription& description, const std::vector<std::size_t>& triangle_counts,
                   Scene& scene) {
    std::vector<std::size_t> first_triangle(triangle_counts.size() + 1);
    std::partial_sum(triangle_counts.begin(), triangle_counts.end(), first_triangle.begin() + 1);
    std::vector<std::optional<std::uint32_t>> new_index(description.objects.size());
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < description.objects.size(); ++i) {
        const ObjectShapes& object = description.objects[i];
        const std::size_t first = first_triangle[object.first_shape];
        const std::size_t count = first_triangle[object.first_shape + object.shape_count] - first;
        if (count == 0) continue;
        new_index[i] = static_cast<std::uint32_t>(scene.objects.size());
        scene.objects.push_back(
            {object.name, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
        boxes.push_back(triangle_bounds(scene, first, count));
    }
    for (const InstanceDirective& instance : description.instances) {
        const std::optional<std::uint32_t> object = new_index[instance.object];
        if (!object) continue;
        const auto rows = instance_rows(instance.world_from_object);
        const Bounds box = rows ? transformed(boxes[*object], *rows) : Bounds();
        if (!rows || !is_valid_coordinate(to_float(box.low)) || !is_valid_coordinate(to_float(box.high)))
            throw SceneError(instance.location, "ObjectInstance: object \"" +
                                                    shortened(scene.objects[*object].name) +
                                                    "\" lies beyond 1e15 m");
        scene.instances.push_back({*object, *rows});
    }
}

void collect_mesh_warnings(const std::vector<ShapeDirective>& shapes, const std::vector<Mesh>& meshes,
                           Warnings& warnings) {
    std::size_t degenerate = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        warnings.append(meshes[i].warnings);
        if (degenerate == 0) first = i;
        degenerate += meshes[i].degenerate_triangles;
    }
    if (degenerate > 0)
        warnings.add(shapes[first].parameters.location(),
                     std::to_string(degenerate) + " degenerate triangles are left out, the first ones here");
}

} // namespace

Scene load_scene(const std::filesystem::path& path) {
    SceneDescription description = parse_scene(path);
    Scene scene;
    scene.materials = std::move(description.materials);
    scene.film = description.film;
    scene.camera = make_camera(description.camera, description.film);
    limit_tessellation(description.shapes);
    check_repeated_meshes(description.shapes);
    std::vector<Mesh> meshes;
    std::vector<BakedTexture> textures;
    Warnings texture_warnings;
    tbb::parallel_invoke(
        [&] { textures = bake_textures(description.textures, *description.budget, texture_warnings); },
        [&] { meshes = build_meshes(description.shapes); });
    description.warnings.append(texture_warnings);
    set_mappings(textures, scene.materials);
    for (BakedTexture& texture : textures) scene.textures.push_back(std::move(texture.texture));
    name_emitters(description.shapes, meshes, EmitterNames(path), scene.emitters);
    const std::vector<std::size_t> triangle_counts = sizes_of(meshes, &Mesh::triangles);
    join_meshes(description.shapes, meshes, scene);
    add_instances(description, triangle_counts, scene);
    collect_mesh_warnings(description.shapes, meshes, description.warnings);
    if (scene.triangles.empty() && scene.polygon_lights.empty() && scene.line_lights.empty())
        description.warnings.add({&description.sources.front(), 1}, "the scene is empty");
    scene.radius = scene_radius(scene);
    scene.warnings = description.warnings.lines();
    return scene;
}

} // namespace nusselt::scene
