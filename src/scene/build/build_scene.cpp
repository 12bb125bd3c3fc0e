#include "scene/build/build_scene.h"

#include "scene/build/build_shape.h"
#include "scene/build/lights/dark_portals.h"
#include "scene/build/lights/surrounding_light.h"
#include "scene/build/parallel.h"
#include "scene/build/textures/surface_formula.h"
#include "scene/build/textures/texture_bake.h"
#include "scene/input/file_bytes.h"
#include "scene/model/bounds.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace nusselt::scene {

namespace {

/// Limits the memory that files take which many shapes name: each shape has its own triangles.
void check_repeated_meshes(const std::vector<PlacedShape>& shapes, const FormatWords& words) {
    std::unordered_map<std::string, std::uint64_t> sizes;
    std::uint64_t repeated = 0;
    for (const PlacedShape& placed : shapes) {
        if (placed.shape == nullptr) continue;
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

/// Reports all missing files before any of the others is read.
void check_files_exist(const std::vector<PlacedShape>& shapes, SceneDescription& description) {
    NamedFiles& files = description.named_files;
    for (const PlacedShape& placed : shapes) {
        if (placed.shape == nullptr) continue;
        if (const MeshFile* const file = std::get_if<MeshFile>(&placed.shape->geometry))
            files.note(file->origin, "mesh file", file->path);
    }
    for (const ImageRequest& image : needed_images(description.textures))
        files.note(image.location, "texture file", image.path);
    files.report_missing();
}

std::vector<BuiltShape> build_shapes(const std::vector<PlacedShape>& shapes,
                                     const SceneDescription& description) {
    std::vector<BuiltShape> built(shapes.size());
    parallel_for_each_index(shapes.size(), [&](std::size_t i) {
        built[i] = shapes[i].built != nullptr
                       ? std::move(*shapes[i].built)
                       : build_shape(shapes[i], *description.budget, description.words, *description.images);
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
    EmitterNames(const std::vector<EmitterOrigin>& origins, const std::filesystem::path& scene)
        : origins_(origins), folder_(scene.parent_path()), counts_(origins.size()) {
        // Sorting takes less memory than a table of names.
        std::vector<std::uint32_t> order(origins.size());
        std::iota(order.begin(), order.end(), 0u);
        const auto key = [&](std::uint32_t i) {
            const EmitterOrigin& origin = origins[i];
            return std::tuple(origin.location.file, origin.location.line, origin.kind);
        };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        for (std::size_t i = 1; i < order.size(); ++i)
            if (key(order[i]) == key(order[i - 1])) counts_[order[i]] = counts_[order[i - 1]] + 1;
    }

    std::string name(std::size_t i) {
        const auto& [kind, location] = origins_[i];
        std::string name = std::string(kind) + " at " + path(*location.file);
        if (location.line > 0) name += ":" + std::to_string(location.line);
        if (counts_[i] > 0) name += " #" + std::to_string(counts_[i] + 1);
        name.shrink_to_fit();
        return name;
    }

private:
    const std::string& path(const SourceFile& file) {
        std::string& text = paths_[&file];
        if (text.empty()) {
            const std::filesystem::path relative = file.path.lexically_relative(folder_);
            text = (relative.empty() ? file.path : relative).string();
        }
        return text;
    }

    const std::vector<EmitterOrigin>& origins_;
    std::filesystem::path folder_;
    std::vector<std::uint32_t> counts_; ///< of equal names before
    std::unordered_map<const SourceFile*, std::string> paths_;
};

std::vector<Emitter> name_emitters(const std::vector<EmitterOrigin>& origins,
                                   const std::filesystem::path& scene) {
    EmitterNames names(origins, scene);
    std::vector<Emitter> emitters;
    emitters.reserve(origins.size());
    for (std::size_t i = 0; i < origins.size(); ++i) emitters.push_back({names.name(i)});
    return emitters;
}

/// Adds a black material that surfaces without one share.
void replace_missing_materials(std::vector<std::uint32_t>& triangle_material,
                               std::vector<Material>& materials) {
    constexpr auto kMissing = static_cast<std::uint32_t>(kNoMaterial);
    if (std::find(triangle_material.begin(), triangle_material.end(), kMissing) == triangle_material.end())
        return;
    std::replace(triangle_material.begin(), triangle_material.end(), kMissing,
                 static_cast<std::uint32_t>(materials.size()));
    materials.push_back(black_material());
}

/// Moves what the shapes consist of to the scene.
void take_shapes(BuiltShape&& shapes, const std::filesystem::path& path, Scene& scene) {
    // First, because the origins can be released before the arrays below grow.
    scene.emitters = name_emitters(shapes.emitters, path);
    shapes.emitters = std::vector<EmitterOrigin>(); // `= {}` would keep the memory
    scene.positions = std::move(shapes.positions);
    scene.normals = std::move(shapes.normals);
    scene.uvs = std::move(shapes.uvs);
    scene.normals.resize(scene.positions.size(), {0, 0, 0});
    scene.uvs.resize(scene.positions.size(), {0, 0});
    scene.triangles = std::move(shapes.triangles);
    scene.triangle_light = std::move(shapes.triangle_light);
    scene.triangle_light.resize(scene.triangles.size(), -1);
    scene.triangle_material = std::move(shapes.triangle_material);
    replace_missing_materials(scene.triangle_material, scene.materials);
    scene.lights.append(std::move(shapes.lights));
    scene.emission_textures = std::move(shapes.emission_textures);
    scene.emission_profiles = std::move(shapes.emission_profiles);
    scene.luminaires = std::move(shapes.luminaires);
    scene.environment_maps = std::move(shapes.environment_maps);
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

void collect_warnings(const BuiltShape& shapes, Warnings& warnings) {
    warnings.append(shapes.warnings);
    if (shapes.first_degenerate)
        warnings.add(*shapes.first_degenerate, std::to_string(shapes.degenerate_triangles) +
                                                   " degenerate triangles are skipped, starting here");
}

} // namespace

Scene build_scene(SceneDescription description) {
    Scene scene;
    scene.materials = std::move(description.materials);
    scene.film = description.film;
    PlacedShapes placed = place_shapes(description);
    scene.camera = make_camera(description.camera, description.film);
    limit_tessellation(placed.shapes);
    check_files_exist(placed.shapes, description);
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
    const std::vector<std::size_t> triangle_counts = sizes_of(built, &BuiltShape::triangles);
    BuiltShape shapes = join(std::move(built), description.words.instance);
    add_light_sources(description.light_sources, scene.textures, shapes);
    collect_warnings(shapes, description.warnings);
    const std::vector<EmitterOrigin> environments = environment_origins(shapes);
    take_shapes(std::move(shapes), description.sources.front().path, scene);
    add_instances(description, placed.objects, triangle_counts, scene);
    if (scene.triangles.empty() && scene.lights.empty())
        description.warnings.add({&description.sources.front(), 1}, "the scene is empty");
    const auto& files = description.named_files.existing();
    scene.files = {description.sources.front().path};
    scene.files.insert(scene.files.end(), files.begin(), files.end());
    scene.radius = scene_radius(scene);
    warn_of_dark_portals(scene, environments, description.warnings);
    warn_of_surrounding_lights(scene, description.warnings);
    scene.warnings = description.warnings.lines();
    return scene;
}

} // namespace nusselt::scene
