#include "light_edits.h"

#include "scene/model/lights/light_geometry.h"
#include "scene/model/transform.h"
#include "scene/rig/light_edit.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nusselt::viewer {

namespace {

using scene::Double3;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTubeThickness = 0.02; ///< radius over length of a new tube

double angle_of(const Double3& turn) { return length(turn); }

/// Two unit vectors that span the plane with this normal.
std::pair<Double3, Double3> plane_axes(const Double3& normal) {
    const Double3 other = std::abs(normal.y) < 0.9 ? Double3{0, 1, 0} : Double3{0, 0, 1};
    const Double3 right = normalized(cross(other, normal));
    return {right, cross(normal, right)};
}

scene::RoundLight sphere_of(const NewLight& light) {
    const auto radius = static_cast<float>(0.5 * light.size);
    scene::RoundLight sphere;
    sphere.center = to_float(light.center);
    sphere.u = {radius, 0, 0};
    sphere.v = {0, radius, 0};
    sphere.w = {0, 0, radius};
    sphere.radiance = light.radiance;
    return sphere;
}

scene::Lights shape_of(const NewLight& light) {
    if (light.shape == LightShape::sphere) return only(sphere_of(light));
    if (light.shape == LightShape::tube) {
        scene::LineLight tube;
        const Double3 half = (0.5 * light.size) * light.direction;
        tube.start = to_float(light.center - half);
        tube.end = to_float(light.center + half);
        tube.radius = static_cast<float>(kTubeThickness * light.size);
        tube.radiance = light.radiance;
        return only(tube);
    }
    const auto [right, up] = plane_axes(light.direction);
    const Double3 x = (0.5 * light.size) * right;
    const Double3 y = (0.5 * light.size) * up;
    if (light.shape == LightShape::disk) {
        scene::RoundLight disk;
        disk.model = scene::RoundModel::ellipse;
        disk.center = to_float(light.center);
        disk.u = to_float(x);
        disk.v = to_float(y);
        disk.w = {0, 0, 0};
        disk.radiance = light.radiance;
        return only(disk);
    }
    scene::PolygonLight panel;
    panel.vertices = {to_float(light.center - x - y), to_float(light.center + x - y),
                      to_float(light.center + x + y), to_float(light.center - x + y)};
    panel.radiance = light.radiance;
    return only(panel);
}

/// A light as it is before its edit.
scene::Lights parts_of(const scene::Scene& loaded, std::size_t light, const LightEdit& edit) {
    if (edit.added) return shape_of(*edit.added);
    scene::Lights parts;
    for (const scene::LightList& list : loaded.lights)
        for (std::size_t i = 0; i < list.size(); ++i)
            if (list.emitter(i) == light) parts.append(list, i);
    return parts;
}

Double3 centroid(const scene::Lights& parts) {
    scene::Moment moment;
    for (const scene::LightList& list : parts) list.add_to(moment);
    return moment.centroid();
}

/// \param quantity of the emission of the light
scene::LightChanges changes_of(const LightEdit& edit, const scene::EmissionQuantity& quantity) {
    scene::LightChanges changes;
    if (edit.added) {
        changes.shape = shape_of(*edit.added);
        changes.emission = {quantity, edit.added->radiance};
    }
    if (edit.size != 1) changes.scale = Double3{edit.size, edit.size, edit.size};
    if (angle_of(edit.turn) > 0) changes.rotation = {normalized(edit.turn), angle_of(edit.turn)};
    changes.move = edit.move;
    if (angle_of(edit.map_turn) > 0)
        changes.map_rotation = {normalized(edit.map_turn), angle_of(edit.map_turn)};
    changes.image = edit.image;
    changes.profile = edit.profile;
    if (const auto* const emission = std::get_if<scene::Float3>(&edit.colour))
        changes.emission = {quantity, *emission};
    if (const auto* const temperature = std::get_if<Temperature>(&edit.colour))
        changes.kelvin = temperature->kelvin;
    // Rigs do not scale an emission that they set.
    if (changes.emission)
        changes.emission->value = to_float(edit.brightness * to_double(changes.emission->value));
    else if (edit.brightness != 1)
        changes.scale_radiance = edit.brightness;
    changes.enabled = edit.is_enabled;
    changes.remove = edit.is_removed;
    return changes;
}

nlohmann::ordered_json triple(const Double3& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json rotation_of(const scene::Rotation& rotation) {
    return {{"axis", triple(rotation.axis)}, {"degrees", rotation.degrees}};
}

void write_files(const scene::LightChanges& changes, nlohmann::ordered_json& entry) {
    if (changes.map_rotation) entry["rotate_map"] = rotation_of(*changes.map_rotation);
    if (changes.image.image != nullptr) entry["image"] = changes.image.image->path;
    if (changes.image.map != nullptr) entry["map"] = changes.image.map->path;
    if (changes.image.scale) entry["image_scale"] = triple(to_double(*changes.image.scale));
    const scene::GivenProfile& profile = changes.profile;
    if (profile.luminaire != nullptr) entry["ies"] = profile.luminaire->path;
    if (profile.angle) entry["ies_degrees"] = *profile.angle;
    if (profile.spread) entry["spread"] = *profile.spread;
    if (profile.honeycomb) entry["honeycomb"] = {profile.honeycomb->along, profile.honeycomb->across};
}

/// The fields of changes_of() in a rig.
void write_changes(const scene::LightChanges& changes, nlohmann::ordered_json& entry) {
    if (changes.shape)
        for (const scene::LightList& list : std::as_const(*changes.shape))
            if (list.size() > 0) entry.update(nlohmann::ordered_json::parse("{" + list.rig_field(0) + "}"));
    if (changes.scale) entry["scale"] = changes.scale->x;
    if (changes.rotation) entry["rotate"] = rotation_of(*changes.rotation);
    entry["move"] = triple(*changes.move);
    write_files(changes, entry);
    if (changes.emission)
        entry[std::string(changes.emission->quantity.name)] = triple(to_double(changes.emission->value));
    if (changes.kelvin) entry["kelvin"] = *changes.kelvin;
    if (changes.scale_radiance) entry["scale_radiance"] = *changes.scale_radiance;
    entry["enabled"] = *changes.enabled;
    if (changes.remove) entry["remove"] = true;
}

/// A rotation as a quaternion: its vector part, then the real one.
std::pair<Double3, double> quaternion(const Double3& turn) {
    const double half = 0.5 * kDegree * angle_of(turn);
    return {std::sin(half) * normalized(turn), std::cos(half)};
}

} // namespace

Double3 combined_turn(const Double3& first, const Double3& second) {
    const auto [a, real_a] = quaternion(second);
    const auto [b, real_b] = quaternion(first);
    Double3 vector = real_a * b + real_b * a + cross(a, b);
    double real = real_a * real_b - dot(a, b);
    // The shorter way.
    if (real < 0) {
        vector = -1 * vector;
        real = -real;
    }
    return (2 * std::atan2(length(vector), real) / kDegree) * normalized(vector);
}

scene::Lights placed(scene::Lights parts, const LightEdit& edit) {
    const Double3 center = centroid(parts);
    scene::Transform transform =
        scene::scaling({edit.size, edit.size, edit.size}) * scene::translation(-1.0 * center);
    if (angle_of(edit.turn) > 0) transform = scene::rotation(angle_of(edit.turn), edit.turn) * transform;
    transform = scene::translation(center + edit.move) * transform;
    for (scene::LightList& list : parts) list.transform(transform);
    return parts;
}

std::string_view name_of(LightShape shape) {
    constexpr std::array<std::string_view, kLightShapes.size()> kNames = {"panel", "tube", "sphere", "disk"};
    return kNames.at(static_cast<std::size_t>(shape));
}

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

std::size_t LightEdits::add(const scene::Scene& loaded, NewLight light) {
    std::size_t index = loaded.emitters.size();
    if (!edits_.empty()) index = std::max(index, edits_.rbegin()->first + 1);
    const auto is_taken = [&](const std::string& name) {
        for (const scene::Emitter& emitter : loaded.emitters)
            if (emitter.name == name) return true;
        return std::any_of(edits_.begin(), edits_.end(), [&](const auto& entry) {
            return entry.second.added && entry.second.added->name == name;
        });
    };
    int number = 1;
    while (is_taken(light.name + " " + std::to_string(number))) ++number;
    light.name += " " + std::to_string(number);
    LightEdit edit;
    edit.added = std::move(light);
    edits_[index] = edit;
    return index;
}

void LightEdits::remove(std::size_t light) {
    LightEdit edit = get(light);
    if (edit.added) {
        edits_.erase(light);
        return;
    }
    edit.is_removed = true;
    set(light, edit);
}

std::vector<std::size_t> LightEdits::lights(const scene::Scene& loaded) const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < loaded.emitters.size(); ++i)
        if (has(loaded, i)) all.push_back(i);
    for (auto added = edits_.lower_bound(loaded.emitters.size()); added != edits_.end(); ++added)
        all.push_back(added->first);
    return all;
}

bool LightEdits::has(const scene::Scene& loaded, std::size_t light) const {
    if (light >= loaded.emitters.size()) return edits_.count(light) > 0;
    return edits_.empty() || !get(light).is_removed;
}

std::string LightEdits::name(const scene::Scene& loaded, std::size_t light) const {
    return light < loaded.emitters.size() ? loaded.emitters[light].name : get(light).added->name;
}

scene::Lights LightEdits::placed(const scene::Scene& loaded, std::size_t light) const {
    const LightEdit edit = get(light);
    return viewer::placed(parts_of(loaded, light, edit), edit);
}

Double3 LightEdits::center(const scene::Scene& loaded, std::size_t light) const {
    const LightEdit edit = get(light);
    return centroid(parts_of(loaded, light, edit)) + edit.move;
}

const scene::EmissionQuantity& LightEdits::quantity(const scene::Scene& loaded, std::size_t light) const {
    const scene::EmissionQuantity* const quantity = quantity_of(parts_of(loaded, light, get(light)));
    return quantity != nullptr ? *quantity : scene::kRadiance;
}

scene::Float3 LightEdits::emission_before(const scene::Scene& loaded, std::size_t light) const {
    Double3 sum;
    double weight = 0;
    const scene::Lights parts = parts_of(loaded, light, get(light));
    for (const scene::LightList& list : parts)
        for (std::size_t i = 0; i < list.size(); ++i) {
            const Double3 flux = list.flux_per_emission(i, loaded.radius);
            const double part = flux.x + flux.y + flux.z;
            sum = sum + part * to_double(list.emission(i));
            weight += part;
        }
    return weight > 0 ? to_float((1 / weight) * sum) : scene::Float3{0, 0, 0};
}

scene::Scene LightEdits::applied_to(const scene::Scene& loaded) const {
    scene::Scene scene = loaded;
    scene::Rig rig;
    for (const auto& [light, edit] : edits_) {
        scene::RigLight entry;
        entry.where = "light " + std::to_string(light);
        if (edit.added)
            entry.lights = scene::LightAddition{edit.added->name, {}, {{}}};
        else
            entry.lights = scene::Selector(light);
        entry.changes = changes_of(edit, quantity(loaded, light));
        rig.lights.push_back(entry);
    }
    scene::apply_rig(rig, scene);
    return scene;
}

std::string LightEdits::rig_text(const scene::Scene& loaded) const {
    nlohmann::ordered_json lights = nlohmann::ordered_json::array();
    for (const auto& [light, edit] : edits_) {
        nlohmann::ordered_json entry;
        if (edit.added)
            entry["add"] = edit.added->name;
        else
            entry["light"] = light;
        write_changes(changes_of(edit, quantity(loaded, light)), entry);
        lights.push_back(entry);
    }
    return nlohmann::ordered_json{{"version", 1}, {"lights", lights}}.dump(2) + "\n";
}

} // namespace nusselt::viewer
