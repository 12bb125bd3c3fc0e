#include "scene/rig/rig.h"

#include "scene/build/lights/dark_portals.h"
#include "scene/build/lights/emission_warnings.h"
#include "scene/build/lights/surrounding_light.h"
#include "scene/colour/spectrum.h"
#include "scene/input/message.h"
#include "scene/model/polygon.h"
#include "scene/model/vector_math.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/light_image.h"
#include "scene/rig/light_profile.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

namespace nusselt::scene {

namespace {

/// The name of the material for new lights without one.
constexpr const char* kBlackMaterial = "black surface of a light";

// Defaults for materials that gain a specular component.
constexpr Float3 kDefaultF0 = {0.04f, 0.04f, 0.04f};
constexpr float kDefaultRoughness = 0.5f;

[[noreturn]] void fail(const std::string& where, const std::string& message) {
    throw std::runtime_error(message_line(where + ": " + message));
}

[[noreturn]] void fail(const std::string& where, const std::string& field, const std::string& message) {
    fail(where + "." + field, message);
}

/// A name in quotes.
std::string in_quotes(const std::string& name) { return '"' + shortened(name) + '"'; }

/// The names of materials, or of lights that have not been removed, by index. Pointers avoid copies: scenes may have very
/// many names, and rigs may select very often.
using NameOf = std::function<const std::string*(std::size_t)>; // null where there is none

/// \param kind   "light" or "material"
/// \param count  of the indices, from 0
std::string nothing_selected(const std::string& kind, const Selector& selector, std::size_t count,
                             const NameOf& name_of) {
    constexpr std::size_t kShown = 10;
    std::string list;
    std::size_t named = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string* const name = name_of(i);
        if (name != nullptr && ++named <= kShown) list += (named > 1 ? ", " : " ") + in_quotes(*name);
    }
    std::string text;
    if (const auto* const index = std::get_if<std::size_t>(&selector))
        text = kind + " " + std::to_string(*index) + " does not exist" +
               (named > 0 ? " (the first one is 0)" : "");
    else
        text = "no " + kind + " matches " + in_quotes(std::get<std::string>(selector));
    if (named == 0) return text + "; the scene has no " + kind + "s";
    text += "; use one of" + list;
    if (named > kShown) text += " and " + std::to_string(named - kShown) + " more";
    return text;
}

/// The indices of the selected lights or materials.
std::vector<std::size_t> select(const Selector& selector, std::size_t count, const NameOf& name_of) {
    if (const auto* const index = std::get_if<std::size_t>(&selector)) {
        if (*index < count && name_of(*index) != nullptr) return {*index};
        return {};
    }
    const std::string& pattern = std::get<std::string>(selector);
    std::vector<std::size_t> exact;
    std::vector<std::size_t> matching;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string* const name = name_of(i);
        if (name == nullptr) continue;
        if (*name == pattern) exact.push_back(i);
        if (exact.empty() && matches(*name, pattern)) matching.push_back(i);
    }
    return exact.empty() ? matching : exact;
}

Transform about(const Double3& center, const Transform& transform) {
    return translation(center) * transform * translation(-1.0 * center);
}

template <class Change>
void change_values(EditableLight& light, const Change& change) {
    for (LightList& list : light.parts)
        for (std::size_t i = 0; i < list.size(); ++i) list.emission(i) = change(list.emission(i));
}

/// A value in a rig replaces a number and the image beside it.
template <class Value>
void replace(const std::optional<Value>& given, Value& value, TextureUse& texture) {
    if (!given) return;
    value = *given;
    texture = {};
}

Float3 scaled(double factor, const Float3& colour) { return to_float(factor * to_double(colour)); }

bool is_valid(const EditableLight& light) {
    for (const LightList& list : light.parts)
        for (std::size_t i = 0; i < list.size(); ++i)
            if (!list.is_valid(i)) return false;
    return true;
}

/// A kind of light among its parts for which a condition holds, null if there is none.
template <class Condition>
const LightList* find_part(const EditableLight& light, const Condition& condition) {
    for (const LightList& list : light.parts)
        if (list.size() > 0 && condition(list)) return &list;
    return nullptr;
}

/// The colour of a black body in linear sRGB, with the luminance 1. Below 1900 K it lies outside the gamut.
Double3 blackbody_colour(double kelvin) {
    const Double3 rgb = srgb_of(blackbody(kelvin), SpectrumUse::illuminant);
    const Double3 visible = {std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0)};
    return (1 / luminance(visible)) * visible;
}

class RigApplication {
public:
    explicit RigApplication(Scene& scene) : scene_(scene), editor_(scene) {
        for (const EditableLight& light : editor_.lights()) names_.insert(light.name);
    }
    void apply(const RigMaterial& entry);
    void apply(const RigLight& entry);
    void finish();

private:
    // Both throw if nothing is selected.
    std::vector<std::size_t> select_materials(const std::string& where, const Selector& selector) const;
    std::vector<std::size_t> select_lights(const std::string& where, const Selector& selector);
    void add(const RigLight& entry, const LightAddition& addition);
    std::uint32_t surface_material(const RigLight& entry, const LightAddition& addition);
    std::uint32_t black_material();
    void change(const RigLight& entry, EditableLight& light, const Double3& offset);
    void rename(const RigLight& entry, EditableLight& light);
    void move(const RigLight& entry, EditableLight& light, const Double3& offset);
    void replace_shape(const RigLight& entry, EditableLight& light, const Lights& shape);
    void change_sides(const RigLight& entry, bool two_sided, EditableLight& light) const;
    void change_emission(const RigLight& entry, EditableLight& light) const;
    void warn_of_dark_lights(Warnings& warnings) const;
    void warn_of_dark_portals(Warnings& warnings) const;
    void warn_of_surrounding_lights(Warnings& warnings) const;

    Scene& scene_;
    LightEditor editor_;
    std::unordered_multiset<std::string> names_;
    /// The last entry of each light that it may have left dark.
    std::unordered_map<std::string, const RigLight*> changed_by_;
};

void RigApplication::apply(const RigMaterial& entry) {
    for (const std::size_t i : select_materials(entry.where, entry.materials)) {
        Material& material = scene_.materials[i];
        const bool is_lambert = material.model == BrdfModel::lambert;
        const BrdfModel kept = is_lambert && entry.f0 ? BrdfModel::frostbite : material.model;
        const BrdfModel model = entry.model.value_or(kept);
        if (is_lambert && model != BrdfModel::lambert) {
            replace(std::optional(kDefaultF0), material.f0, material.f0_texture);
            replace(std::optional(kDefaultRoughness), material.roughness, material.roughness_texture);
        }
        material.model = model;
        replace(entry.diffuse, material.diffuse, material.diffuse_texture);
        replace(entry.f0, material.f0, material.f0_texture);
        replace(entry.roughness, material.roughness, material.roughness_texture);
        if (entry.exponent) material.exponent = *entry.exponent;
    }
}

void RigApplication::apply(const RigLight& entry) {
    if (const auto* const addition = std::get_if<LightAddition>(&entry.lights)) {
        add(entry, *addition);
        return;
    }
    const std::vector<std::size_t> selected = select_lights(entry.where, std::get<Selector>(entry.lights));
    const LightChanges& changes = entry.changes;
    if (selected.size() > 1 && (changes.name || changes.shape || changes.center))
        fail(entry.where, "light",
             "selects " + std::to_string(selected.size()) + " lights, but a " +
                 (changes.name    ? "name"
                  : changes.shape ? "shape"
                                  : "center") +
                 " applies to a single light");
    for (const std::size_t i : selected) change(entry, editor_.lights()[i], {});
}

std::vector<std::size_t> RigApplication::select_materials(const std::string& where,
                                                          const Selector& selector) const {
    const auto name_of = [&](std::size_t i) { return &scene_.materials[i].name; };
    std::vector<std::size_t> selected = select(selector, scene_.materials.size(), name_of);
    if (selected.empty())
        fail(where, "material", nothing_selected("material", selector, scene_.materials.size(), name_of));
    return selected;
}

std::vector<std::size_t> RigApplication::select_lights(const std::string& where, const Selector& selector) {
    const std::vector<EditableLight>& lights = editor_.lights();
    const auto name_of = [&](std::size_t i) { return lights[i].is_removed ? nullptr : &lights[i].name; };
    std::vector<std::size_t> selected = select(selector, lights.size(), name_of);
    if (selected.empty()) fail(where, "light", nothing_selected("light", selector, lights.size(), name_of));
    return selected;
}

void RigApplication::add(const RigLight& entry, const LightAddition& addition) {
    const std::uint32_t material = surface_material(entry, addition);
    const bool is_single = addition.offsets.size() == 1;
    if (editor_.lights().size() + addition.offsets.size() > kMaxRigLights)
        fail(entry.where, "add",
             "the scene would have more than " + std::to_string(kMaxRigLights) + " lights");
    for (std::size_t i = 0; i < addition.offsets.size(); ++i) {
        const std::string name = is_single ? addition.name : addition.name + " " + std::to_string(i);
        if (names_.count(name) > 0)
            fail(entry.where, "add", "light " + in_quotes(name) + " already exists; use another name");
        names_.insert(name);
        EditableLight& light = editor_.lights().emplace_back();
        light.name = name;
        light.material = material;
        change(entry, light, addition.offsets[i]);
    }
}

std::uint32_t RigApplication::surface_material(const RigLight& entry, const LightAddition& addition) {
    if (!addition.material) return black_material();
    // The name is no pattern, because a surface has one material.
    const auto& materials = scene_.materials;
    const auto found = std::find_if(materials.begin(), materials.end(), [&](const Material& material) {
        return material.name == *addition.material;
    });
    if (found == materials.end())
        fail(entry.where, "material",
             nothing_selected("material", *addition.material, materials.size(),
                              [&](std::size_t i) { return &materials[i].name; }));
    return static_cast<std::uint32_t>(found - materials.begin());
}

std::uint32_t RigApplication::black_material() {
    for (std::size_t i = scene_.materials.size(); i-- > 0;)
        if (scene_.materials[i].name == kBlackMaterial) return static_cast<std::uint32_t>(i);
    Material material;
    material.name = kBlackMaterial;
    material.diffuse = {0, 0, 0};
    scene_.materials.push_back(material);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

void RigApplication::change(const RigLight& entry, EditableLight& light, const Double3& offset) {
    const LightChanges& changes = entry.changes;
    rename(entry, light);
    if (changes.shape) replace_shape(entry, light, *changes.shape);
    move(entry, light, offset);
    if (!is_valid(light))
        fail(entry.where,
             "light " + in_quotes(light.name) + " would lie beyond 1e15 m, or be too small or too flat");
    const auto check = [&](const std::optional<FieldDefect>& defect) {
        if (defect)
            fail(entry.where, defect->field, "light " + in_quotes(light.name) + ": " + defect->message);
    };
    check(change_image(changes.image, scene_, light));
    if (changes.map_rotation) check(turn_map(*changes.map_rotation, light));
    check(change_profile(changes.profile, scene_, light));
    if (changes.two_sided) change_sides(entry, *changes.two_sided, light);
    change_emission(entry, light); // a power is that of both sides
    if (changes.enabled) light.is_enabled = *changes.enabled;
    // Most lights have nothing that could leave them dark, and there may be a million of them.
    changed_by_.erase(light.name);
    if (!changes.remove) {
        const std::vector<RoundLight>& rounds = light.parts.of<RoundLight>();
        const bool surrounds = std::any_of(rounds.begin(), rounds.end(), [&](const RoundLight& round) {
            return surrounds_camera(scene_, round);
        });
        if (surrounds || darkness(scene_, light.parts) || !light.parts.of<EnvironmentLight>().empty())
            changed_by_[light.name] = &entry;
        return;
    }
    light.is_removed = true;
    names_.erase(names_.find(light.name));
}

void RigApplication::replace_shape(const RigLight& entry, EditableLight& light, const Lights& shape) {
    const EmissionQuantity* const before = quantity_of(light.parts);
    const EmissionQuantity& quantity = *quantity_of(shape);
    // The number of one quantity means nothing for another one.
    if (before != nullptr && *before != quantity && !entry.changes.emission && !entry.changes.power)
        fail(entry.where, "light " + in_quotes(light.name) + " had " + with_article(before->name) +
                              "; give the " + std::string(quantity.name) + " or the power of its new shape");
    const bool has_material = is_surface(light) || std::holds_alternative<LightAddition>(entry.lights);
    // A light that has this shape already keeps its profile with it.
    const KeptProfile profile(scene_, light);
    if (editor_.replace_shape(light, shape, has_material ? light.material : black_material()))
        profile.give_to(scene_, light);
}

void RigApplication::rename(const RigLight& entry, EditableLight& light) {
    const std::optional<std::string>& name = entry.changes.name;
    if (!name || *name == light.name) return;
    if (names_.count(*name) > 0)
        fail(entry.where, "name", "light " + in_quotes(*name) + " already exists; use another name");
    names_.erase(names_.find(light.name));
    names_.insert(*name);
    changed_by_.erase(light.name);
    light.name = *name;
}

void RigApplication::move(const RigLight& entry, EditableLight& light, const Double3& offset) {
    const LightChanges& changes = entry.changes;
    const Double3 center = changes.scale || changes.rotation || changes.center ? centroid(light) : Double3{};
    Transform transform;
    if (changes.scale) {
        const Double3& scale = *changes.scale;
        const LightList* const list =
            find_part(light, [](const LightList& part) { return part.scales_evenly(); });
        if (list != nullptr && (scale.x != scale.y || scale.x != scale.z))
            fail(entry.where, "scale",
                 "light " + in_quotes(light.name) + " is " + with_article(list->noun()) +
                     "; scale it by a single number");
        transform = about(center, scaling(scale));
    }
    if (changes.rotation)
        transform = about(center, rotation(changes.rotation->degrees, changes.rotation->axis)) * transform;
    // The difference is taken in the precision of files, so that a printed centroid moves nothing.
    if (changes.center)
        transform = translation(to_double(*changes.center) - to_double(to_float(center))) * transform;
    if (changes.move) transform = translation(*changes.move) * transform;
    transform = translation(offset) * transform;
    if (!is_identity(transform)) editor_.transform(light, transform);
}

void RigApplication::change_sides(const RigLight& entry, bool two_sided, EditableLight& light) const {
    const auto has_one_side = [](const LightList& list) { return list.two_sided(0) == nullptr; };
    if (const LightList* const list = find_part(light, has_one_side))
        fail(entry.where, "two_sided",
             "light " + in_quotes(light.name) + " is " + with_article(list->noun()) +
                 ", which has no second side");
    bool is_changed = false;
    for (LightList& list : light.parts) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            is_changed |= *list.two_sided(i) != two_sided;
            *list.two_sided(i) = two_sided;
        }
    }
    if (is_changed) refit_profile(scene_, light);
}

void RigApplication::change_emission(const RigLight& entry, EditableLight& light) const {
    const LightChanges& changes = entry.changes;
    if (changes.emission) {
        const auto& [quantity, value] = *changes.emission;
        // clang 14 does not capture structured bindings.
        const auto has_another = [&quantity = quantity](const LightList& list) {
            return list.quantity() != quantity;
        };
        if (const LightList* const list = find_part(light, has_another))
            fail(entry.where, std::string(quantity.name),
                 "light " + in_quotes(light.name) + " is " + with_article(list->noun()) + "; use " +
                     std::string(list->quantity().name) + " [" + std::string(list->quantity().unit) + "]");
        change_values(light, [&value = value](const Float3&) { return value; });
    }
    const std::string name(quantity_of(light.parts)->name);
    if ((changes.kelvin || changes.power) && is_black(light))
        fail(entry.where, changes.kelvin ? "kelvin" : "power",
             "light " + in_quotes(light.name) + " is black; use " + name + " instead");
    if (changes.kelvin) {
        const Double3 colour = blackbody_colour(*changes.kelvin);
        change_values(light, [&](const Float3& c) { return to_float(luminance(to_double(c)) * colour); });
    }
    if (changes.scale_radiance)
        change_values(light, [&](const Float3& c) { return scaled(*changes.scale_radiance, c); });
    if (changes.power) {
        const double factor = *changes.power / luminous_power(light, scene_.radius);
        change_values(light, [&](const Float3& c) { return scaled(factor, c); });
    }
    const auto check = [&](const Float3& c) {
        if (!(std::max({c.x, c.y, c.z}) <= kMaxRadiance))
            fail(entry.where, "light " + in_quotes(light.name) + " would have " + with_article(name) +
                                  " above " + to_text(kMaxRadiance));
        return c;
    };
    change_values(light, check);
    if (drop_dark_channels(light))
        fail(entry.where, "light " + in_quotes(light.name) + " would emit less than " + to_text(kDarkest) +
                              " W/(sr m^2) of its image");
    const bool is_changed = changes.emission || changes.kelvin || changes.scale_radiance || changes.power ||
                            changes.image.image != nullptr || changes.image.map != nullptr;
    if (is_changed && has_too_bright_texels(scene_, light))
        fail(entry.where, "light " + in_quotes(light.name) + " would have texels with a radiance above " +
                              to_text(kMaxRadiance));
}

void warn(const RigLight& entry, const std::string& name, const std::string& clause, Warnings& warnings) {
    warnings.add({}, entry.where + ": light " + in_quotes(name) + ": " + clause);
}

void RigApplication::warn_of_dark_lights(Warnings& warnings) const {
    if (changed_by_.empty()) return;
    for (const EditableLight& light : editor_.lights()) {
        const auto change = changed_by_.find(light.name);
        if (change == changed_by_.end() || !light.is_enabled || light.is_removed) continue;
        if (const Darkness dark = darkness(scene_, light.parts))
            warn(*change->second, light.name, *dark, warnings);
    }
}

void RigApplication::warn_of_dark_portals(Warnings& warnings) const {
    DarkPortals portals(scene_);
    for (const EnvironmentLight& light : scene_.lights.of<EnvironmentLight>()) {
        const std::string& name = scene_.emitters[light.emitter].name;
        const auto change = changed_by_.find(name);
        if (change == changed_by_.end()) continue;
        if (const Darkness dark = portals.of(light)) warn(*change->second, name, *dark, warnings);
    }
}

void RigApplication::warn_of_surrounding_lights(Warnings& warnings) const {
    const std::vector<RoundLight>& lights = scene_.lights.of<RoundLight>();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::string& name = scene_.emitters[lights[i].emitter].name;
        const auto change = changed_by_.find(name);
        if (change == changed_by_.end()) continue;
        if (const Darkness dark = darkness_inside(scene_, i)) warn(*change->second, name, *dark, warnings);
    }
}

void RigApplication::finish() {
    Warnings warnings;
    // Those that emit nothing are no longer in the scene afterwards.
    warn_of_dark_lights(warnings);
    editor_.finish();
    warn_of_dark_portals(warnings);
    warn_of_surrounding_lights(warnings);
    const std::vector<std::string> lines = warnings.lines();
    scene_.warnings.insert(scene_.warnings.end(), lines.begin(), lines.end());
}

} // namespace

bool matches(std::string_view text, std::string_view pattern) {
    // The text that the last star stands for grows until the rest of the pattern matches.
    std::size_t t = 0;
    std::size_t p = 0;
    std::size_t after_star = pattern.npos;
    std::size_t star_end = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            after_star = ++p;
            star_end = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (after_star != pattern.npos) {
            p = after_star;
            t = ++star_end;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == pattern.npos;
}

void apply_rig(const Rig& rig, Scene& scene) {
    RigApplication application(scene);
    for (const RigMaterial& entry : rig.materials) application.apply(entry);
    for (const RigLight& entry : rig.lights) application.apply(entry);
    application.finish();
}

} // namespace nusselt::scene
