#include "scene/rig/rig_json.h"

#include "scene/input/json_node.h"
#include "scene/input/message.h"
#include "scene/model/limits.h"
#include "scene/model/polygon.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/rig_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace nusselt::scene {

namespace {

constexpr double kMaxScale = 1e9;
constexpr double kMaxDegrees = 3600;
constexpr std::size_t kMaxIndex = 0xffffffff;

constexpr std::array kLightSynonyms = std::to_array<FieldSynonym>({
    {"color", "radiance"},
    {"colour", "radiance"},
    {"emission", "radiance"},
    {"L", "radiance"},
    {"brightness", "scale_radiance"},
    {"temperature", "kelvin"},
    {"position", "center"},
    {"translate", "move"},
    {"delete", "remove"},
    {"visible", "enabled"},
});
constexpr std::array kMaterialSynonyms = std::to_array<FieldSynonym>({
    {"color", "diffuse"},
    {"colour", "diffuse"},
    {"albedo", "diffuse"},
    {"reflectance", "diffuse"},
    {"specular", "f0"},
});

Float3 read_point(const JsonNode& node) { return float3_of(node.triple(-kMaxCoordinate, kMaxCoordinate)); }
Float3 read_emission(const JsonNode& node) { return float3_of(node.triple_or_number(0, kMaxRadiance)); }
float read_length(const JsonNode& node) { return static_cast<float>(node.positive_number(kMaxCoordinate)); }

/// A vector of length 1.
Double3 read_direction(const JsonNode& node) {
    const Double3 v = to_double(read_point(node));
    if (!(length(v) > 0)) node.fail("must not be zero");
    return normalized(v);
}

Selector read_selector(const JsonNode& node) {
    if (node.is_text()) return node.text();
    if (!node.is_number()) node.fail_type("an index or a name");
    return node.integer(0, kMaxIndex);
}

Lights polygon_of(const std::vector<Float3>& vertices) {
    PolygonLight light;
    light.vertices = vertices;
    return only(light);
}

Lights read_polygon(const JsonNode& node) {
    std::vector<Float3> vertices;
    std::vector<Double3> points;
    for (const JsonNode& vertex : node.elements()) {
        vertices.push_back(read_point(vertex));
        points.push_back(to_double(vertices.back()));
    }
    if (const auto defect = find_polygon_defect(points)) node.fail(*defect);
    return polygon_of(vertices);
}

Lights read_panel(const JsonNode& node) {
    node.check_fields({"center", "normal", "up", "width", "height"});
    const Double3 center = to_double(read_point(node.at("center")));
    const Double3 normal = read_direction(node.at("normal"));
    constexpr double kMinSine = 1e-3;
    Double3 up = {0, 1, 0};
    if (const auto given = node.find("up")) {
        up = read_direction(*given);
        if (length(cross(up, normal)) < kMinSine) given->fail("must not be parallel to the normal");
    } else if (length(cross(up, normal)) < kMinSine) {
        up = {0, 0, 1};
    }
    const Double3 right = normalized(cross(up, normal));
    const Double3 x = (0.5 * read_length(node.at("width"))) * right;
    const Double3 y = (0.5 * read_length(node.at("height"))) * cross(normal, right);
    return polygon_of({to_float(center - x - y), to_float(center + x - y), to_float(center + x + y),
                       to_float(center - x + y)});
}

/// The semi-diameters of an ellipse or an ellipsoid.
void read_axes(const JsonNode& node, std::initializer_list<Float3*> axes) {
    const std::vector<JsonNode> given = node.elements();
    if (given.size() != axes.size())
        node.fail("must be " + std::to_string(axes.size()) + " semi-diameters, found " +
                  std::to_string(given.size()));
    for (std::size_t i = 0; i < given.size(); ++i) *axes.begin()[i] = read_point(given[i]);
}

/// \returns the light, if it has an area and is not too flat
Lights checked(const JsonNode& node, const RoundLight& light) {
    if (!LightKind<RoundLight>::is_valid(light))
        node.fail(
            "must have an extent of at least 1e-9 m within 1e15 m, and may be at most 1e4 times as long as "
            "wide or high");
    return only(light);
}

RoundModel read_side(const JsonNode& node) {
    const auto inwards = node.find("inwards");
    return inwards && inwards->boolean() ? RoundModel::hollow : RoundModel::ellipsoid;
}

Lights read_sphere(const JsonNode& node) {
    node.check_fields({"center", "radius", "inwards"});
    RoundLight light;
    light.model = read_side(node);
    light.center = read_point(node.at("center"));
    const float radius = read_length(node.at("radius"));
    light.u.x = light.v.y = light.w.z = radius;
    return checked(node, light);
}

Lights read_ellipsoid(const JsonNode& node) {
    node.check_fields({"center", "axes", "inwards"});
    RoundLight light;
    light.model = read_side(node);
    light.center = read_point(node.at("center"));
    read_axes(node.at("axes"), {&light.u, &light.v, &light.w});
    return checked(node, light);
}

Lights read_disk(const JsonNode& node) {
    node.check_fields({"center", "normal", "radius"});
    RoundLight light;
    light.model = RoundModel::ellipse;
    light.center = read_point(node.at("center"));
    const Double3 normal = read_direction(node.at("normal"));
    const double radius = read_length(node.at("radius"));
    const Double3 other = std::fabs(normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 across = normalized(cross(other, normal));
    light.u = to_float(radius * across);
    light.v = to_float(radius * cross(normal, across));
    light.w = {0, 0, 0};
    return checked(node, light);
}

Lights read_ellipse(const JsonNode& node) {
    node.check_fields({"center", "axes"});
    RoundLight light;
    light.model = RoundModel::ellipse;
    light.center = read_point(node.at("center"));
    read_axes(node.at("axes"), {&light.u, &light.v});
    light.w = {0, 0, 0};
    return checked(node, light);
}

LineLight read_line(const JsonNode& node) {
    LineLight line;
    line.start = read_point(node.at("begin"));
    line.end = read_point(node.at("end"));
    if (!(length(to_double(line.end) - to_double(line.start)) > 0)) node.fail("begin and end must differ");
    return line;
}

/// A unit vector perpendicular to a line.
Float3 read_normal(const JsonNode& node, const LineLight& line) {
    const Double3 axis = normalized(to_double(line.end) - to_double(line.start));
    const Double3 across = cross(axis, read_direction(node));
    if (!(length(across) > 0)) node.fail("must not be parallel to the line");
    return to_float(normalized(cross(across, axis)));
}

Lights read_tube(const JsonNode& node) {
    node.check_fields({"begin", "end", "radius", "finite", "caps", "normal"});
    LineLight tube = read_line(node);
    if (const auto normal = node.find("normal")) tube.normal = read_normal(*normal, tube);
    tube.radius = read_length(node.at("radius"));
    if (const auto finite = node.find("finite"))
        tube.model = finite->boolean() ? TubeModel::solid : TubeModel::linear;
    if (const auto caps = node.find("caps")) {
        const std::string kind = caps->text();
        if (kind != "bright" && kind != "dark") caps->fail_type("\"bright\" or \"dark\"");
        if (tube.model == TubeModel::linear) caps->fail("needs a tube with \"finite\": true");
        if (kind == "dark") tube.model = TubeModel::open;
    }
    return only(tube);
}

Lights read_strip(const JsonNode& node) {
    node.check_fields({"begin", "end", "normal", "width"});
    LineLight strip = read_line(node);
    strip.model = TubeModel::strip;
    strip.radius = 0.5f * read_length(node.at("width"));
    strip.normal = read_normal(node.at("normal"), strip);
    return only(strip);
}

Lights read_point_light(const JsonNode& node) {
    PointLight light;
    light.position = read_point(node);
    return only(light);
}

Lights read_spot(const JsonNode& node) {
    node.check_fields({"position", "direction", "degrees", "full_degrees", "falloff"});
    PointLight light;
    light.distribution = PointDistribution::smooth_cone;
    light.position = read_point(node.at("position"));
    light.z_axis = to_float(read_direction(node.at("direction")));
    light.cone_angle = static_cast<float>(node.at("degrees").number(kNarrowestCone, 180));
    const auto full = node.find("full_degrees");
    light.full_angle = full ? static_cast<float>(full->number(0, static_cast<double>(light.cone_angle)))
                            : std::max(light.cone_angle - 5, 0.0f);
    if (const auto falloff = node.find("falloff")) {
        const std::string kind = falloff->text();
        if (kind != "smooth" && kind != "quartic") falloff->fail_type("\"smooth\" or \"quartic\"");
        if (kind == "quartic") light.distribution = PointDistribution::quartic_cone;
    }
    return only(light);
}

Lights read_distant_light(const JsonNode& node) {
    DistantLight light;
    light.direction = to_float(read_direction(node));
    return only(light);
}

Rotation read_rotation(const JsonNode& node) {
    node.check_fields({"axis", "degrees"});
    return {read_direction(node.at("axis")), node.at("degrees").number(-kMaxDegrees, kMaxDegrees)};
}

Double3 read_scale(const JsonNode& node) {
    const Float3 scale = float3_of(node.triple_or_number(0, kMaxScale));
    if (!(std::min({scale.x, scale.y, scale.z}) > 0)) node.fail("must be above 0");
    return to_double(scale);
}

/// The offsets of a grid; the first axis varies fastest.
std::vector<Double3> read_copies(const JsonNode& node) {
    node.check_fields({"count", "step"});
    const JsonNode count = node.at("count");
    const std::vector<JsonNode> counts = count.elements();
    const std::vector<JsonNode> steps = node.at("step").elements();
    if (counts.empty() || counts.size() > 3 || counts.size() != steps.size())
        node.fail("must have as many counts as steps, 1 to 3, found " + std::to_string(counts.size()) +
                  " and " + std::to_string(steps.size()));
    std::vector<Double3> offsets = {{}};
    for (std::size_t axis = 0; axis < counts.size(); ++axis) {
        const std::size_t n = counts[axis].integer(1, kMaxRigLights);
        const Double3 step = to_double(read_point(steps[axis]));
        if (offsets.size() * n > kMaxRigLights)
            count.fail("creates more than " + std::to_string(kMaxRigLights) + " lights");
        const std::size_t row = offsets.size();
        for (std::size_t i = row; i < row * n; ++i)
            offsets.push_back(offsets[i % row] + static_cast<double>(i / row) * step);
    }
    return offsets;
}

/// The one of these fields that an entry has; empty if it has none. Throws if it has several.
std::optional<JsonNode> find_one(const JsonNode& entry, const std::vector<std::string_view>& fields) {
    std::optional<JsonNode> found;
    std::string_view found_name;
    for (const std::string_view name : fields) {
        std::optional<JsonNode> node = entry.find(name);
        if (!node) continue;
        if (found)
            entry.fail("has \"" + std::string(found_name) + "\" and \"" + std::string(name) +
                       "\"; keep one of them");
        found = std::move(node);
        found_name = name;
    }
    return found;
}

/// A field that gives the shape of a light.
struct ShapeField {
    std::string_view name;
    Lights (*read)(const JsonNode& node);
};

constexpr ShapeField kShapeFields[] = {{"polygon", read_polygon},
                                       {"panel", read_panel},
                                       {"sphere", read_sphere},
                                       {"ellipsoid", read_ellipsoid},
                                       {"disk", read_disk},
                                       {"ellipse", read_ellipse},
                                       {"tube", read_tube},
                                       {"strip", read_strip},
                                       {"point", read_point_light},
                                       {"spot", read_spot},
                                       {"distant", read_distant_light}};

std::vector<std::string_view> shape_field_names() {
    std::vector<std::string_view> names;
    for (const ShapeField& field : kShapeFields) names.push_back(field.name);
    return names;
}

/// The fields with shapes, in quotes.
std::string any_shape() {
    std::string text;
    for (const std::string_view name : shape_field_names())
        text += (text.empty() ? "\"" : ", \"") + std::string(name) + '"';
    return text;
}

std::optional<Lights> read_shape(const JsonNode& entry) {
    if (!find_one(entry, shape_field_names())) return std::nullopt;
    for (const ShapeField& field : kShapeFields)
        if (const auto node = entry.find(field.name)) return field.read(*node);
    return std::nullopt;
}

std::vector<std::string_view> emission_field_names() {
    std::vector<std::string_view> names;
    for (const EmissionQuantity& quantity : kEmissionQuantities) names.push_back(quantity.name);
    return names;
}

/// The files of a rig, and where it looks for them.
struct NamedFiles {
    std::filesystem::path folder; ///< of the rig
    RigFiles files = {};
};

/// What a function reads from a file that a rig names.
template <class Content>
std::shared_ptr<const Content>
read_file(const JsonNode& node, NamedFiles& named,
          std::shared_ptr<const Content> (RigFiles::*read)(const std::filesystem::path&)) {
    const std::filesystem::path path = named.folder / node.text();
    try {
        return (named.files.*read)(path);
    } catch (const std::exception& error) {
        node.fail(error.what());
    }
}

GivenImage read_image(const JsonNode& entry, NamedFiles& named) {
    GivenImage given;
    const auto node = find_one(entry, {"image", "map"});
    const auto scale = entry.find("image_scale");
    if (scale) {
        if (!node) scale->fail("needs \"image\" or \"map\"");
        given.scale = read_emission(*scale);
    }
    if (!node) return given;
    if (entry.find("map"))
        given.map = read_file(*node, named, &RigFiles::map);
    else
        given.image = read_file(*node, named, &RigFiles::image);
    return given;
}

/// One angle, or those along and across.
HoneycombAngles read_honeycomb(const JsonNode& node) {
    const auto angle = [](const JsonNode& number) { return number.number(kNarrowestSpread, kWidestSpread); };
    if (node.is_number()) return {angle(node), angle(node)};
    const std::vector<JsonNode> angles = node.elements();
    if (angles.size() != 2) node.fail("must be one or two angles, found " + std::to_string(angles.size()));
    return {angle(angles[0]), angle(angles[1])};
}

GivenProfile read_profile(const JsonNode& entry, NamedFiles& named) {
    GivenProfile profile;
    if (const auto node = entry.find("ies")) profile.luminaire = read_file(*node, named, &RigFiles::profile);
    if (const auto node = entry.find("spread"))
        profile.spread = node->number(kNarrowestSpread, kWidestSpread);
    if (const auto node = entry.find("honeycomb")) {
        if (profile.spread) node->fail("does not work together with \"spread\"; keep one of them");
        profile.honeycomb = read_honeycomb(*node);
    }
    if (const auto node = entry.find("ies_degrees")) profile.angle = node->number(-kMaxDegrees, kMaxDegrees);
    return profile;
}

LightChanges read_changes(const JsonNode& entry, NamedFiles& named) {
    LightChanges changes;
    changes.profile = read_profile(entry, named);
    changes.image = read_image(entry, named);
    if (const auto node = entry.find("rotate_map")) changes.map_rotation = read_rotation(*node);
    if (const auto node = entry.find("name")) changes.name = node->text();
    changes.shape = read_shape(entry);
    if (const auto node = entry.find("scale")) changes.scale = read_scale(*node);
    if (const auto node = entry.find("rotate")) changes.rotation = read_rotation(*node);
    if (const auto node = entry.find("center")) changes.center = read_point(*node);
    if (const auto node = entry.find("move")) changes.move = to_double(read_point(*node));
    std::vector<std::string_view> brightness = emission_field_names();
    brightness.insert(brightness.end(), {"scale_radiance", "power"});
    find_one(entry, brightness);
    for (const EmissionQuantity& quantity : kEmissionQuantities)
        if (const auto node = entry.find(quantity.name))
            changes.emission = GivenEmission{quantity, read_emission(*node)};
    if (const auto node = entry.find("kelvin")) changes.kelvin = node->number(1000, 40000);
    if (const auto node = entry.find("power")) changes.power = node->number(0, kMaxRadiance);
    if (const auto node = entry.find("scale_radiance"))
        changes.scale_radiance = node->number(0, kMaxRadiance);
    if (const auto node = entry.find("two_sided")) changes.two_sided = node->boolean();
    if (const auto node = entry.find("enabled")) changes.enabled = node->boolean();
    if (const auto node = entry.find("remove")) changes.remove = node->boolean();
    return changes;
}

LightAddition read_addition(const JsonNode& entry, const LightChanges& changes) {
    LightAddition addition;
    addition.name = entry.at("add").text();
    if (!changes.shape) entry.fail("must have a shape; add one of " + any_shape());
    if (!changes.emission && !changes.power && changes.profile.luminaire == nullptr && !changes.image.scale)
        entry.fail("must have " + with_article(quantity_of(*changes.shape)->name) +
                   (changes.image.image != nullptr ? ", a power or an image_scale" : " or a power"));
    if (const auto name = entry.find("name"))
        name->fail("is not supported for new lights; set their name in \"add\"");
    if (const auto material = entry.find("material")) {
        if (surface_light_count(*changes.shape) == 0)
            for (const LightList& list : std::as_const(*changes.shape))
                if (list.size() > 0) material->fail(std::string(list.noun()) + "s have no material");
        addition.material = material->text();
    }
    const auto copies = entry.find("copies");
    addition.offsets = copies ? read_copies(*copies) : std::vector<Double3>{{}};
    return addition;
}

RigLight read_light(const JsonNode& entry, NamedFiles& named) {
    std::vector<std::string_view> fields = {"light", "add", "comment", "name"};
    const std::vector<std::string_view> shapes = shape_field_names();
    fields.insert(fields.end(), shapes.begin(), shapes.end());
    const std::vector<std::string_view> emission = emission_field_names();
    fields.insert(fields.end(), emission.begin(), emission.end());
    fields.insert(fields.end(), {"material",  "scale",          "rotate", "center",      "move",
                                 "copies",    "kelvin",         "power",  "enabled",     "two_sided",
                                 "remove",    "scale_radiance", "ies",    "ies_degrees", "spread",
                                 "honeycomb", "image",          "map",    "image_scale", "rotate_map"});
    entry.check_fields(fields, kLightSynonyms);
    if (!find_one(entry, {"light", "add"}))
        entry.fail(
            "must have the field \"light\", which selects lights, or \"add\" with the name of a new one");
    RigLight result;
    result.where = entry.where();
    result.changes = read_changes(entry, named);
    if (const auto light = entry.find("light")) {
        for (const char* field : {"copies", "material"})
            if (const auto node = entry.find(field)) node->fail("is supported only for new lights");
        result.lights = read_selector(*light);
    } else {
        result.lights = read_addition(entry, result.changes);
    }
    return result;
}

BrdfModel read_model(const JsonNode& node) {
    const std::string name = node.text();
    if (name == "lambert") return BrdfModel::lambert;
    if (name == "frostbite") return BrdfModel::frostbite;
    if (name == "phong") return BrdfModel::phong;
    node.fail_type("\"lambert\", \"frostbite\" or \"phong\"");
}

float read_exponent(const JsonNode& node) {
    const double exponent = node.number(0, kLargestPhongExponent);
    if (exponent > 0 && exponent < 1) node.fail("must not be between 0 and 1");
    return static_cast<float>(exponent);
}

/// The model of a material without the field "model", if its parameters tell it.
std::optional<BrdfModel> implied_model(const JsonNode& entry, const RigMaterial& material) {
    if (material.roughness && material.exponent)
        entry.fail("roughness belongs to the model \"frostbite\", exponent to \"phong\"; use one of them");
    if (material.roughness) return BrdfModel::frostbite;
    if (material.exponent) return BrdfModel::phong;
    return std::nullopt;
}

RigMaterial read_material(const JsonNode& entry) {
    entry.check_fields({"material", "comment", "model", "diffuse", "f0", "roughness", "exponent"},
                       kMaterialSynonyms);
    RigMaterial result;
    result.where = entry.where();
    result.materials = read_selector(entry.at("material"));
    if (const auto node = entry.find("diffuse")) result.diffuse = float3_of(node->triple_or_number(0, 1));
    if (const auto node = entry.find("f0")) result.f0 = float3_of(node->triple_or_number(0, 1));
    if (const auto node = entry.find("roughness")) result.roughness = static_cast<float>(node->number(0, 1));
    if (const auto node = entry.find("exponent")) result.exponent = read_exponent(*node);
    const auto node = entry.find("model");
    if (!node) {
        result.model = implied_model(entry, result);
        return result;
    }
    const BrdfModel model = read_model(*node);
    const auto require = [&](bool is_given, const char* field, bool is_supported) {
        if (is_given && !is_supported)
            node->fail("\"" + node->text() + "\" does not support " + std::string(field));
    };
    require(result.f0.has_value(), "f0", model != BrdfModel::lambert);
    require(result.roughness.has_value(), "roughness", model == BrdfModel::frostbite);
    require(result.exponent.has_value(), "exponent", model == BrdfModel::phong);
    result.model = model;
    return result;
}

Rig rig_of(const nlohmann::json& document, const std::filesystem::path& path) {
    const JsonNode root(document, path);
    root.check_fields({"version", "comment", "lights", "materials"});
    root.at("version").integer(1, 1);
    Rig rig;
    NamedFiles named{path.parent_path()};
    if (const auto lights = root.find("lights"))
        for (const JsonNode& entry : lights->elements()) rig.lights.push_back(read_light(entry, named));
    if (const auto materials = root.find("materials"))
        for (const JsonNode& entry : materials->elements()) rig.materials.push_back(read_material(entry));
    return rig;
}

} // namespace

Rig read_rig(const std::filesystem::path& path) { return rig_of(read_json(path), path); }

Rig parse_rig(std::string_view text, const std::filesystem::path& path) {
    return rig_of(parse_json(text, path), path);
}

} // namespace nusselt::scene
