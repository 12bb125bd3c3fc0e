#include "scene/load.h"

#include "scene/parser.h"
#include "scene/vector_math.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <tbb/parallel_for.h>
#include <unordered_map>
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

/// Renumbers the images that materials use and returns the requests for them.
std::vector<ImageRequest> select_images(const std::vector<ImageRequest>& images,
                                        std::vector<Material>& materials) {
    std::vector<ImageRequest> used;
    std::vector<int> new_index(images.size(), -1);
    for (Material& material : materials) {
        const int texture = material.diffuse_texture.texture;
        if (texture < 0) continue;
        int& index = new_index[static_cast<std::size_t>(texture)];
        if (index < 0) {
            index = static_cast<int>(used.size());
            used.push_back(images[static_cast<std::size_t>(texture)]);
        }
        material.diffuse_texture.texture = index;
    }
    return used;
}

/// Decodes images and builds meshes, in parallel.
std::vector<Mesh> read_files(const std::vector<ImageRequest>& images, std::vector<ShapeDirective>& shapes,
                             std::vector<Texture>& textures) {
    std::vector<Mesh> meshes(shapes.size());
    textures.resize(images.size());
    // Images come first: each of them takes longer than most meshes.
    tbb::parallel_for(std::size_t{0}, images.size() + shapes.size(), [&](std::size_t i) {
        if (i < images.size()) {
            textures[i] = decode_image(images[i]);
        } else {
            meshes[i - images.size()] = build_mesh(shapes[i - images.size()]);
        }
    });
    return meshes;
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
    std::size_t lights = 0;
    for (Mesh& mesh : meshes) {
        const auto first_vertex = static_cast<std::uint32_t>(vertices);
        const auto first_light = static_cast<std::int32_t>(lights);
        vertices += mesh.positions.size();
        lights += mesh.polygon_lights.size();
        if (vertices > std::numeric_limits<std::uint32_t>::max())
            throw std::runtime_error("the scene has more than 2^32 vertices");
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
    for (const PolygonLight& light : scene.polygon_lights)
        for (const Float3& p : light.vertices) bounds.add(to_double(p));
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
    const std::vector<ImageRequest> images = select_images(description.images, scene.materials);
    limit_tessellation(description.shapes);
    std::vector<Mesh> meshes = read_files(images, description.shapes, scene.textures);
    name_emitters(description.shapes, meshes, EmitterNames(path), scene.emitters);
    join_meshes(description.shapes, meshes, scene);
    collect_mesh_warnings(description.shapes, meshes, description.warnings);
    if (scene.triangles.empty() && scene.polygon_lights.empty() && scene.line_lights.empty())
        description.warnings.add({&description.sources.front(), 1}, "the scene is empty");
    scene.radius = scene_radius(scene);
    scene.warnings = description.warnings.lines();
    return scene;
}

} // namespace nusselt::scene
