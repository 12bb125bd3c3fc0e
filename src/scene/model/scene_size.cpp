#include "scene/model/scene_size.h"

#include "scene/model/limits.h"

#include <stdexcept>

namespace nusselt::scene {

namespace {

template <class... Arrays>
std::size_t bytes_of(const Arrays&... arrays) {
    return ((arrays.size() * sizeof(typename Arrays::value_type)) + ...);
}

} // namespace

std::size_t array_bytes(const Scene& scene) {
    std::size_t bytes = bytes_of(scene.positions, scene.normals, scene.uvs, scene.triangles,
                                 scene.triangle_material, scene.triangle_light, scene.objects,
                                 scene.instances, scene.materials, scene.textures, scene.emitters);
    for (const LightList& list : scene.lights) bytes += list.bytes();
    for (const Texture& texture : scene.textures) bytes += bytes_of(texture.texels);
    return bytes;
}

void check_counts(std::size_t vertices, std::size_t triangles, std::string_view copies) {
    const auto fail = [copies](std::size_t limit, const std::string& what) {
        throw std::runtime_error("the scene has more than " + std::to_string(limit) + " " + what + "; use " +
                                 std::string(copies) + " for copies, or simplify it");
    };
    if (vertices > kMaxVertices) fail(kMaxVertices, "vertices");
    if (triangles > kMaxTriangles) fail(kMaxTriangles, "triangles");
}

} // namespace nusselt::scene
