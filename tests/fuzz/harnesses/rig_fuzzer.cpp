/// Light rigs, applied to a scene with lights of all sorts; what is left of it must again be a rig.

#include "files.h"
#include "scene/import/importers.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"
#include "scene/rig/rig_text.h"
#include "scene_contract.h"

namespace nusselt::fuzz {
namespace {

constexpr std::string_view kScene = R"(Camera "perspective"
WorldBegin
MakeNamedMaterial "wall" "string type" "matte"
MakeNamedMaterial "shiny" "string type" "uber" "float roughness" 0.2
NamedMaterial "wall"
Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]
NamedMaterial "shiny"
AreaLightSource "diffuse" "rgb L" [1 2 3]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [0 0 1 1 0 1 1 1 1 0 1 1]
AreaLightSource "diffuse" "rgb L" [3 2 1] "bool twosided" true
Shape "trianglemesh" "integer indices" [0 1 2 1 0 3] "point3 P" [0 0 2 1 0 2 0 1 2 0 0 3]
Shape "cylinder" "float radius" 0.01 "float zmin" -1 "float zmax" 1
)";

struct SceneFolder : Folder {
    SceneFolder() { write("scene.pbrt", kScene); }
};

/// Throws std::runtime_error if the rig is refused.
void apply(const std::filesystem::path& rig, scene::Scene& scene) {
    scene::apply_rig(scene::read_rig(rig), scene);
    fail_if_any(violation(scene));
}

} // namespace
} // namespace nusselt::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nusselt;
    static const fuzz::SceneFolder kFolder;
    static const scene::Scene kScene = scene::load_scene(kFolder / "scene.pbrt");
    kFolder.write("rig.json", fuzz::text(data, size));
    scene::Scene scene = kScene;
    bool is_accepted = false;
    fuzz::read_or_refuse([&] {
        fuzz::apply(kFolder / "rig.json", scene);
        is_accepted = true;
    });
    if (!is_accepted) return 0;
    kFolder.write("printed.json", scene::to_rig_text(scene));
    fuzz::apply(kFolder / "printed.json", scene);
    return 0;
}
