#include "lab/lines/line_scenes.h"

#include "render/film.h"
#include "scene/import/importers.h"
#include "scene/rig/rig_json.h"

#include <utility>

namespace nusselt::lab {

namespace {

constexpr const char* kSmallLight = "small-light.json";

std::vector<LineScene> scenes_with(const std::string& rig, const std::string& sponza) {
    return {{"grid-planes", "grid-planes.pbrt", rig},
            {"logo", "logo.pbrt", rig},
            {"soup", "soup.pbrt", rig},
            {"sponza", sponza, "", SceneOrigin::published}};
}

} // namespace

std::vector<LineScene> scenes_with_large_lights() { return scenes_with("", "sponza/sponza.pbrt"); }

std::vector<LineScene> scenes_with_small_lights() {
    return scenes_with(kSmallLight, "sponza/sponza-small-light.pbrt");
}

std::string published_name(const std::string& scene) {
    const std::pair<std::string, std::string> names[] = {{"grid-planes", "Grid planes"},
                                                         {"logo", "Eurographics logo"},
                                                         {"soup", "Triangle soup"},
                                                         {"sponza", "Sponza"}};
    for (const auto& [ours, theirs] : names)
        if (scene.rfind(ours, 0) == 0) return theirs + scene.substr(ours.size());
    return scene;
}

std::optional<scene::Scene> load_line_scene(const LineScene& line_scene, const RunSettings& settings,
                                            int width) {
    std::filesystem::path folder = settings.scenes;
    if (line_scene.origin == SceneOrigin::published) {
        const auto published = published_scenes();
        if (!published) return std::nullopt;
        folder = *published;
        if (!std::filesystem::exists(folder / line_scene.file))
            throw std::runtime_error("NUSSELT_SCENES names '" + folder.string() + "', which has no " +
                                     line_scene.file);
    }
    scene::Scene scene = scene::load_scene(folder / line_scene.file);
    if (!line_scene.rig.empty()) {
        const std::filesystem::path rig = settings.scenes / "rigs" / line_scene.rig;
        scene::apply_rig(scene::read_rig(rig), scene);
        scene.files.push_back(rig);
    }
    if (width > 0) render::resize_film_to_width(scene, width);
    return scene;
}

} // namespace nusselt::lab
