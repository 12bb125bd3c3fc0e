/// PLY meshes: alone, and as a light in a scene.

#include "files.h"
#include "scene/import/ply/ply.h"
#include "scene_contract.h"

namespace nusselt::fuzz {
namespace {

std::string_view violation_of_mesh(const scene::Mesh& mesh) {
    const std::size_t vertex_count = mesh.positions.size();
    if (!mesh.normals.empty() && mesh.normals.size() != vertex_count) return "normals differ in number";
    if (!mesh.uvs.empty() && mesh.uvs.size() != vertex_count) return "texture coordinates differ in number";
    for (const scene::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle.vertex)
            if (vertex >= vertex_count) return "a triangle has no such vertex";
    return {};
}

/// A folder with a scene in which mesh.ply emits.
struct SceneFolder : Folder {
    SceneFolder() {
        write("scene.pbrt", "Camera \"perspective\"\nWorldBegin\nAreaLightSource \"diffuse\"\n"
                            "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n");
    }
};

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt;
    const std::string_view bytes = fuzz::text(data, size);
    fuzz::read_or_refuse([&] { fuzz::fail_if_any(fuzz::violation_of_mesh(scene::read_ply(bytes))); });
    static const fuzz::SceneFolder kFolder;
    kFolder.write("mesh.ply", bytes);
    fuzz::load_or_refuse(kFolder / "scene.pbrt");
    return 0;
}
