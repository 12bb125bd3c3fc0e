#include "scene/load.h"

#include "scene/parser.h"
#include "scene/vector_math.h"

#include <algorithm>
#include <limits>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <utility>

namespace nusselt::scene {

namespace {

struct Bounds {
    Double3 low = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
                   std::numeric_limits<double>::max()};
    Double3 high = -1.0 * low;

    void add(const Double3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
};

/// Where the contents of a mesh begin in the arrays of the scene.
struct Offsets {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t lights = 0;
};

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

void copy_mesh(const Mesh& mesh, int material, const Offsets& offsets, Scene& scene) {
    const auto at = [](auto& array, std::size_t offset) {
        return array.begin() + static_cast<std::ptrdiff_t>(offset);
    };
    std::copy(mesh.positions.begin(), mesh.positions.end(), at(scene.positions, offsets.vertices));
    std::copy(mesh.normals.begin(), mesh.normals.end(), at(scene.normals, offsets.vertices));
    std::copy(mesh.uvs.begin(), mesh.uvs.end(), at(scene.uvs, offsets.vertices));
    const auto base = static_cast<std::uint32_t>(offsets.vertices);
    std::transform(mesh.triangles.begin(), mesh.triangles.end(), at(scene.triangles, offsets.triangles),
                   [base](const Triangle& t) {
                       return Triangle{{t.vertex[0] + base, t.vertex[1] + base, t.vertex[2] + base}};
                   });
    std::fill_n(at(scene.triangle_material, offsets.triangles), mesh.triangles.size(),
                static_cast<std::uint32_t>(material));
    const auto first_light = static_cast<std::int32_t>(offsets.lights);
    std::transform(mesh.triangle_light.begin(), mesh.triangle_light.end(),
                   at(scene.triangle_light, offsets.triangles),
                   [first_light](std::int32_t light) { return light + first_light; });
}

void join_meshes(const std::vector<ShapeDirective>& shapes, std::vector<Mesh>& meshes, Scene& scene) {
    std::vector<Offsets> offsets;
    Offsets total;
    for (Mesh& mesh : meshes) {
        offsets.push_back(total);
        total.vertices += mesh.positions.size();
        total.triangles += mesh.triangles.size();
        total.lights += mesh.polygon_lights.size();
        const auto emitter = static_cast<std::uint32_t>(scene.emitters.size());
        for (PolygonLight& light : mesh.polygon_lights) light.emitter = emitter;
        for (LineLight& light : mesh.line_lights) light.emitter = emitter;
        if (!mesh.emitter_name.empty()) scene.emitters.push_back({std::move(mesh.emitter_name)});
        std::move(mesh.polygon_lights.begin(), mesh.polygon_lights.end(),
                  std::back_inserter(scene.polygon_lights));
        std::move(mesh.line_lights.begin(), mesh.line_lights.end(), std::back_inserter(scene.line_lights));
    }
    if (total.vertices > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("the scene has more than 2^32 vertices");
    scene.positions.resize(total.vertices);
    scene.normals.resize(total.vertices);
    scene.uvs.resize(total.vertices);
    scene.triangles.resize(total.triangles);
    scene.triangle_material.resize(total.triangles);
    scene.triangle_light.resize(total.triangles, -1);
    tbb::parallel_for(std::size_t{0}, meshes.size(),
                      [&](std::size_t i) { copy_mesh(meshes[i], shapes[i].material, offsets[i], scene); });
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

double scene_radius(const Scene& scene) {
    Bounds bounds;
    for (const Float3& p : scene.positions) bounds.add(to_double(p));
    for (const LineLight& line : scene.line_lights) {
        const Double3 margin = {line.radius, line.radius, line.radius};
        for (const Float3& end : {line.begin, line.end}) {
            bounds.add(to_double(end) - margin);
            bounds.add(to_double(end) + margin);
        }
    }
    return bounds.low.x <= bounds.high.x ? 0.5 * length(bounds.high - bounds.low) : 0;
}

} // namespace

Scene load_scene(const std::filesystem::path& path) {
    SceneDescription description = parse_scene(path);
    Scene scene;
    scene.materials = std::move(description.materials);
    scene.film = description.film;
    scene.camera = make_camera(description.camera, description.film);
    std::vector<Mesh> meshes;
    std::vector<BakedTexture> textures;
    Warnings texture_warnings;
    tbb::parallel_invoke([&] { textures = bake_textures(description.textures, texture_warnings); },
                         [&] { meshes = build_meshes(description.shapes); });
    description.warnings.append(texture_warnings);
    set_mappings(textures, scene.materials);
    for (BakedTexture& texture : textures) scene.textures.push_back(std::move(texture.texture));
    join_meshes(description.shapes, meshes, scene);
    collect_mesh_warnings(description.shapes, meshes, description.warnings);
    if (scene.triangles.empty() && scene.line_lights.empty())
        description.warnings.add({&description.sources.front(), 1}, "the scene is empty");
    scene.radius = scene_radius(scene);
    scene.warnings = description.warnings.lines();
    return scene;
}

} // namespace nusselt::scene
