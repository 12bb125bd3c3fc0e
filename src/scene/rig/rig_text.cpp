#include "scene/rig/rig_text.h"

#include "scene/model/number_text.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/light_image.h"
#include "scene/rig/light_profile.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace nusselt::scene {

namespace {

std::string boolean_text(bool value) { return value ? "true" : "false"; }

/// The text that `get` returns for all parts of a light; empty if they differ. Parts with an empty text do not count.
template <class Get>
std::string common_text(const EditableLight& light, const Get& get) {
    std::string common;
    for (const LightList& list : light.parts) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::string text = get(list, i);
            if (text.empty() || text == common) continue;
            if (!common.empty()) return "";
            common = text;
        }
    }
    return common;
}

/// The field with the shape of a light of one part; empty for other lights, and for shapes without a field.
std::string shape_field(const EditableLight& light) {
    if (light.parts.size() != 1) return "";
    for (const LightList& list : light.parts)
        if (list.size() == 1) return list.rig_field(0);
    return "";
}

/// A name in JSON; empty if JSON cannot represent it.
std::string name_text(const std::string& name) {
    try {
        return name.empty() ? "" : nlohmann::json(name).dump();
    } catch (const nlohmann::json::type_error&) {
        return "";
    }
}

class Fields {
public:
    /// Adds a field unless its value is empty.
    void add(const std::string& name, const std::string& value) {
        if (!value.empty()) add("\"" + name + "\": " + value);
    }
    /// Adds a field with its name unless it is empty.
    void add(const std::string& field) {
        if (!field.empty()) text_ += (text_.empty() ? "\n    {" : ",\n     ") + field;
    }
    std::string text() const { return text_ + "}"; }

private:
    std::string text_;
};

std::string light_text(const Scene& scene, std::size_t index, const EditableLight& light) {
    Fields fields;
    fields.add("light", std::to_string(index));
    fields.add("name", name_text(light.name));
    const std::string shape = shape_field(light);
    fields.add(shape);
    if (shape.empty()) fields.add("center", triple_text(to_float(centroid(light))));
    fields.add("image", name_text(image_path(scene, light)));
    fields.add("map", name_text(map_path(scene, light)));
    const LightProfile profile = profile_of(scene, light);
    if (profile.luminaire != nullptr) fields.add("ies", name_text(profile.luminaire->path));
    if (profile.spread < kWidestSpread) fields.add("spread", number_text(static_cast<float>(profile.spread)));
    if (profile.honeycomb != HoneycombAngles{})
        fields.add("honeycomb", "[" + number_text(static_cast<float>(profile.honeycomb.along)) + ", " +
                                    number_text(static_cast<float>(profile.honeycomb.across)) + "]");
    fields.add(common_text(light, [](const LightList& list, std::size_t i) {
        return "\"" + std::string(list.quantity().name) + "\": " + triple_text(list.emission(i));
    }));
    fields.add("two_sided", common_text(light, [](const LightList& list, std::size_t i) {
                   return list.two_sided(i) == nullptr ? std::string() : boolean_text(*list.two_sided(i));
               }));
    return fields.text();
}

} // namespace

std::string to_rig_text(const Scene& scene) {
    std::string text;
    const std::vector<EditableLight> lights = editable_lights(scene);
    for (std::size_t i = 0; i < lights.size(); ++i)
        text += (i > 0 ? "," : "") + light_text(scene, i, lights[i]);
    return "{\"version\": 1,\n  \"lights\": [" + text + "]}\n";
}

} // namespace nusselt::scene
