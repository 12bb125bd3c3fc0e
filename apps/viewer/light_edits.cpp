#include "light_edits.h"

#include <nlohmann/json.hpp>

namespace nusselt::viewer {

LightEdit LightEdits::get(std::size_t light) const {
    const auto found = edits_.find(light);
    return found == edits_.end() ? LightEdit() : found->second;
}

void LightEdits::set(std::size_t light, const LightEdit& edit) {
    if (edit == LightEdit())
        edits_.erase(light);
    else
        edits_[light] = edit;
}

scene::Scene LightEdits::applied_to(const scene::Scene& loaded) const {
    scene::Scene scene = loaded;
    scene::Rig rig;
    for (const auto& [light, edit] : edits_) {
        scene::RigLight entry;
        entry.where = "light " + std::to_string(light);
        entry.lights = scene::Selector(light);
        if (edit.size != 1) entry.changes.scale = scene::Double3{edit.size, edit.size, edit.size};
        entry.changes.move = edit.move;
        if (edit.brightness != 1) entry.changes.scale_radiance = edit.brightness;
        entry.changes.enabled = edit.is_enabled;
        rig.lights.push_back(entry);
    }
    scene::apply_rig(rig, scene);
    return scene;
}

std::string LightEdits::rig_text() const {
    nlohmann::ordered_json lights = nlohmann::ordered_json::array();
    for (const auto& [light, edit] : edits_) {
        nlohmann::ordered_json entry = {{"light", light}};
        if (edit.size != 1) entry["scale"] = edit.size;
        entry["move"] = {edit.move.x, edit.move.y, edit.move.z};
        if (edit.brightness != 1) entry["scale_radiance"] = edit.brightness;
        entry["enabled"] = edit.is_enabled;
        lights.push_back(entry);
    }
    return nlohmann::ordered_json{{"version", 1}, {"lights", lights}}.dump(2) + "\n";
}

} // namespace nusselt::viewer
