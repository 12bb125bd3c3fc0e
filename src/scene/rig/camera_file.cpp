#include "scene/rig/camera_file.h"

#include "scene/input/json_node.h"
#include "scene/model/limits.h"
#include "scene/model/number_text.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>

namespace nusselt::scene {

namespace {

Float3 scaled(double factor, const Float3& v) { return to_float(factor * to_double(v)); }

/// Directions are normalised in single precision, which squares them.
constexpr float kLongestDirection = 1e9f;

float largest_component(const Float3& v) {
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

Float3 read_vector(const JsonNode& camera, std::string_view field) {
    return float3_of(camera.at(field).triple(-kMaxCoordinate, kMaxCoordinate));
}

Float3 read_vector_or_zero(const JsonNode& camera, std::string_view field) {
    const auto node = camera.find(field);
    return node ? float3_of(node->triple(-kMaxCoordinate, kMaxCoordinate)) : Float3{0, 0, 0};
}

bool is_zero(const Float3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

/// Whether different pixels have different rays.
bool spans_an_image(const Float3& right, const Float3& down) {
    return length(cross(to_double(right), to_double(down))) > 0;
}

bool lie_in_a_plane(const Float3& a, const Float3& b, const Float3& c) {
    return dot(to_double(a), cross(to_double(b), to_double(c))) == 0;
}

} // namespace

std::string to_camera_text(const FilmedCamera& view) {
    const Camera& c = view.camera;
    const auto across = [&](const Float3& per_pixel) { return triple_text(scaled(view.width, per_pixel)); };
    const auto along = [&](const Float3& per_pixel) { return triple_text(scaled(view.height, per_pixel)); };
    std::string text = "{\"version\": 1,\n  \"film\": [" + std::to_string(view.width) + ", " +
                       std::to_string(view.height) + "],\n  \"camera\": {";
    const auto add = [&](const char* field, const std::string& value) {
        text += text.back() == '{' ? "\n    \"" : ",\n    \"";
        text += std::string(field) + "\": " + value;
    };
    add("origin", triple_text(c.origin));
    add("corner", triple_text(c.corner));
    add("right", across(c.right));
    add("down", along(c.down));
    if (!is_zero(c.origin_right) || !is_zero(c.origin_down)) {
        add("origin_right", across(c.origin_right));
        add("origin_down", along(c.origin_down));
    }
    return text + "}}\n";
}

namespace {

FilmedCamera camera_of(const nlohmann::json& document, const std::filesystem::path& path) {
    const JsonNode root(document, path);
    root.check_fields({"version", "film", "camera"});
    root.at("version").integer(1, 1);
    const JsonNode film_node = root.at("film");
    const std::vector<JsonNode> film = film_node.elements();
    if (film.size() != 2) film_node.fail_type("width and height");
    FilmedCamera view;
    view.width = static_cast<int>(film[0].integer(1, kMaxFilmSize));
    view.height = static_cast<int>(film[1].integer(1, kMaxFilmSize));
    const JsonNode node = root.at("camera");
    node.check_fields({"origin", "corner", "right", "down", "origin_right", "origin_down"});
    view.camera.origin = read_vector(node, "origin");
    view.camera.corner = read_vector(node, "corner");
    view.camera.right = scaled(1.0 / view.width, read_vector(node, "right"));
    view.camera.down = scaled(1.0 / view.height, read_vector(node, "down"));
    view.camera.origin_right = scaled(1.0 / view.width, read_vector_or_zero(node, "origin_right"));
    view.camera.origin_down = scaled(1.0 / view.height, read_vector_or_zero(node, "origin_down"));
    if (!spans_an_image(view.camera.right, view.camera.down) &&
        !spans_an_image(view.camera.origin_right, view.camera.origin_down))
        node.fail("right and down (or origin_right and origin_down) must not be parallel");
    if (is_zero(view.camera.corner) && !spans_an_image(view.camera.right, view.camera.down))
        node.at("corner").fail("must not be zero where rays are parallel");
    const bool starts_at_one_point = is_zero(view.camera.origin_right) && is_zero(view.camera.origin_down);
    if (starts_at_one_point && lie_in_a_plane(view.camera.corner, view.camera.right, view.camera.down))
        node.fail("corner, right and down must not lie in one plane");
    const float longest =
        std::max({largest_component(view.camera.corner), largest_component(view.camera.right),
                  largest_component(view.camera.down)});
    if (!(longest >= 1 / kLongestDirection && longest <= kLongestDirection))
        node.fail("the largest component of corner, right and down must lie between 1e-9 and 1e9");
    return view;
}

} // namespace

FilmedCamera read_camera_file(const std::filesystem::path& path) { return camera_of(read_json(path), path); }

FilmedCamera parse_camera(std::string_view text, const std::filesystem::path& path) {
    return camera_of(parse_json(text, path), path);
}

void apply_camera(const FilmedCamera& view, Scene& scene) {
    scene.camera = view.camera;
    scene.film.width = view.width;
    scene.film.height = view.height;
    scene.film.crop.reset();
}

} // namespace nusselt::scene
