#include "scene/scene_size.h"

namespace nusselt::scene {

namespace {

template <class... Arrays>
std::size_t bytes_of(const Arrays&... arrays) {
    return ((arrays.size() * sizeof(typename Arrays::value_type)) + ...);
}

} // namespace

std::size_t array_bytes(const Scene& scene) {
    std::size_t bytes =
        bytes_of(scene.positions, scene.normals, scene.uvs, scene.triangles, scene.triangle_material,
                 scene.triangle_light, scene.objects, scene.instances, scene.materials, scene.textures,
                 scene.emitters, scene.polygon_lights, scene.line_lights);
    for (const Texture& texture : scene.textures) bytes += bytes_of(texture.texels);
    return bytes;
}

} // namespace nusselt::scene
