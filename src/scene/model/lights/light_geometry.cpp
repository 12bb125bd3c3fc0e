#include "scene/model/lights/light_geometry.h"

#include "scene/model/scene_size.h"

namespace nusselt::scene {

LightMesh make_light_mesh(const Scene& scene) {
    LightMesh mesh;
    std::uint32_t number = 0;
    for (const LightList& list : scene.lights) {
        for (std::size_t i = 0; i < list.size(); ++i, ++number) {
            list.add_mesh(i, mesh);
            check_counts(mesh.positions.size(), mesh.triangles.size());
            mesh.lights.resize(mesh.triangles.size(), number);
        }
    }
    return mesh;
}

} // namespace nusselt::scene
