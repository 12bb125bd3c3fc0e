#include "scene/rig/rig_text.h"

#include "scene/model/polygon.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/number_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace nusselt::scene {

namespace {

std::string boolean_text(bool value) { return value ? "true" : "false"; }

/// The value that `get` finds in all parts of a light, nothing if they differ.
template <class Parts, class Get>
std::string common_text(const Parts& parts, const Get& get) {
    if (parts.empty()) return "";
    const std::string text = get(parts.front());
    const bool is_common =
        std::all_of(parts.begin(), parts.end(), [&](const auto& part) { return get(part) == text; });
    return is_common ? text : "";
}

std::string polygon_text(const PolygonLight& light) {
    std::vector<Double3> points;
    for (const Float3& p : light.vertices) points.push_back(to_double(p));
    // Importers merge what readers of rigs might not take for one polygon.
    if (find_polygon_defect(points)) return "";
    std::string text;
    for (const Float3& p : light.vertices) text += (text.empty() ? "[" : ", ") + triple_text(p);
    return text + "]";
}

std::string tube_text(const LineLight& light) {
    return "{\"begin\": " + triple_text(light.start) + ", \"end\": " + triple_text(light.end) +
           ", \"radius\": " + number_text(light.radius) +
           ", \"finite\": " + boolean_text(light.model == TubeModel::solid) + "}";
}

/// Names that JSON cannot hold are left out.
std::string name_text(const std::string& name) {
    try {
        return name.empty() ? "" : nlohmann::json(name).dump();
    } catch (const nlohmann::json::type_error&) {
        return "";
    }
}

class Fields {
public:
    /// Leaves out empty values.
    void add(const std::string& name, const std::string& value) {
        if (value.empty()) return;
        text_ += (text_.empty() ? "\n    {\"" : ",\n     \"") + name + "\": " + value;
    }
    std::string text() const { return text_ + "}"; }

private:
    std::string text_;
};

std::string light_text(std::size_t index, const EditableLight& light) {
    Fields fields;
    fields.add("light", std::to_string(index));
    fields.add("name", name_text(light.name));
    const bool is_single = light.polygons.size() + light.tubes.size() == 1;
    std::string polygon;
    if (is_single && light.tubes.size() == 1) fields.add("tube", tube_text(light.tubes[0]));
    if (is_single && light.polygons.size() == 1) polygon = polygon_text(light.polygons[0]);
    fields.add("polygon", polygon);
    if (polygon.empty() && !light.polygons.empty())
        fields.add("center", triple_text(to_float(centroid(light))));
    const auto radiance = [](const auto& part) { return triple_text(part.radiance); };
    const std::string of_polygons = common_text(light.polygons, radiance);
    fields.add("radiance", light.polygons.empty() ? common_text(light.tubes, radiance) : of_polygons);
    fields.add("two_sided", common_text(light.polygons, [](const PolygonLight& polygon_light) {
                   return boolean_text(polygon_light.two_sided);
               }));
    return fields.text();
}

} // namespace

std::string to_rig_text(const Scene& scene) {
    std::string text;
    const std::vector<EditableLight> lights = editable_lights(scene);
    for (std::size_t i = 0; i < lights.size(); ++i) text += (i > 0 ? "," : "") + light_text(i, lights[i]);
    return "{\"version\": 1,\n  \"lights\": [" + text + "]}\n";
}

} // namespace nusselt::scene
