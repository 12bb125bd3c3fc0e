#include "scene/parser.h"

#include "scene/alpha.h"
#include "scene/graphics_state.h"
#include "scene/tokenizer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr int kMaxIncludeDepth = 32;

class Parser {
public:
    explicit Parser(const std::filesystem::path& main_path) : main_path_(main_path) {
        materials_.push_back({{"default", "matte", ParameterList(), {}}, {}});
        state_.current().material = &materials_.back();
    }

    SceneDescription run();

private:
    using Handler = void (Parser::*)();

    static const std::unordered_map<std::string_view, Handler>& handlers();

    void parse_file(const std::filesystem::path& path, const Location* includer);
    void parse_directive(const Token& directive);
    void skip_unknown_directive(const Token& directive);

    // Directives.
    void identity();
    void translate();
    void scale();
    void rotate();
    void look_at_directive();
    void transform();
    void concat_transform();
    void coordinate_system();
    void coord_sys_transform();
    void reverse_orientation() {
        state_.current().reverse_orientation = !state_.current().reverse_orientation;
    }
    void active_transform();
    void attribute_begin() { state_.push(StateBlock::attribute, location_); }
    void attribute_end() { state_.pop(StateBlock::attribute, location_); }
    void transform_begin() { state_.push(StateBlock::transform, location_); }
    void transform_end() { state_.pop(StateBlock::transform, location_); }
    void object_begin();
    void object_end();
    void object_instance();
    void world_begin();
    void world_end() {}
    void include();
    void import();
    void camera();
    void film();
    void pixel_filter();
    void ignore_with_parameters();
    void ignore_option() { ParameterList(*tokens_, location_); }
    void ignore_string() { read_string(); }
    void light_source();
    void area_light_source();
    void material();
    void make_named_material();
    void named_material();
    void texture();
    void shape();

    // Arguments.
    std::string read_string();
    double read_number();
    Double3 read_vector();
    Transform read_matrix();
    ParameterList read_parameters() { return {*tokens_, location_}; }
    std::filesystem::path resolve(const std::string& name) const;
    void concatenate(const Transform& t) { state_.current().ctm = state_.current().ctm * t; }
    MaterialEntry& add_material(const std::string& name, const std::string& type, ParameterList parameters);
    int used_material(MaterialEntry& entry);
    int black_material();

    std::filesystem::path main_path_;
    SceneDescription scene_;
    StateStack state_;
    std::deque<MaterialEntry> materials_;
    std::unordered_map<std::string, MaterialEntry*> named_materials_;
    std::unordered_map<std::string, Transform> coordinate_systems_;
    std::optional<int> black_material_;
    TextureTable textures_;
    AlphaVariants alpha_variants_;
    std::optional<CameraDirective> camera_;
    int include_depth_ = 0;
    bool inside_object_ = false;

    Tokenizer* tokens_ = nullptr; ///< of the file that is being read
    Location location_;           ///< of the directive that is being read
};

const std::unordered_map<std::string_view, Parser::Handler>& Parser::handlers() {
    static const std::unordered_map<std::string_view, Handler> kHandlers = {
        {"Identity", &Parser::identity},
        {"Translate", &Parser::translate},
        {"Scale", &Parser::scale},
        {"Rotate", &Parser::rotate},
        {"LookAt", &Parser::look_at_directive},
        {"Transform", &Parser::transform},
        {"ConcatTransform", &Parser::concat_transform},
        {"CoordinateSystem", &Parser::coordinate_system},
        {"CoordSysTransform", &Parser::coord_sys_transform},
        {"ReverseOrientation", &Parser::reverse_orientation},
        {"ActiveTransform", &Parser::active_transform},
        {"AttributeBegin", &Parser::attribute_begin},
        {"AttributeEnd", &Parser::attribute_end},
        {"TransformBegin", &Parser::transform_begin},
        {"TransformEnd", &Parser::transform_end},
        {"ObjectBegin", &Parser::object_begin},
        {"ObjectEnd", &Parser::object_end},
        {"ObjectInstance", &Parser::object_instance},
        {"WorldBegin", &Parser::world_begin},
        {"WorldEnd", &Parser::world_end},
        {"Include", &Parser::include},
        {"Import", &Parser::import},
        {"Camera", &Parser::camera},
        {"Film", &Parser::film},
        {"PixelFilter", &Parser::pixel_filter},
        {"Sampler", &Parser::ignore_with_parameters},
        {"Integrator", &Parser::ignore_with_parameters},
        {"SurfaceIntegrator", &Parser::ignore_with_parameters},
        {"Renderer", &Parser::ignore_with_parameters},
        {"Accelerator", &Parser::ignore_with_parameters},
        {"ColorSpace", &Parser::ignore_string},
        {"Option", &Parser::ignore_option},
        {"LightSource", &Parser::light_source},
        {"AreaLightSource", &Parser::area_light_source},
        {"Material", &Parser::material},
        {"MakeNamedMaterial", &Parser::make_named_material},
        {"NamedMaterial", &Parser::named_material},
        {"Texture", &Parser::texture},
        {"Shape", &Parser::shape},
    };
    return kHandlers;
}

SceneDescription Parser::run() {
    coordinate_systems_["world"] = {};
    parse_file(main_path_, nullptr);
    state_.warn_if_open(scene_.warnings);
    const Location begin{&scene_.sources.front(), 1};
    if (!camera_) scene_.warnings.add(begin, "there is no Camera, it looks from the origin along +z");
    if (!camera_) camera_.emplace().location = begin;
    scene_.camera = *camera_;
    scene_.textures = textures_.plan();
    return std::move(scene_);
}

void Parser::parse_file(const std::filesystem::path& path, const Location* includer) {
    if (includer != nullptr && include_depth_ >= kMaxIncludeDepth)
        throw SceneError(*includer, "more than " + std::to_string(kMaxIncludeDepth) +
                                        " nested includes; does '" + path.string() + "' include itself?");
    SourceFile source{path, {}};
    try {
        source.bytes = FileBytes(path);
    } catch (const std::runtime_error& error) {
        const std::string message = "scene file '" + path.string() + "': " + error.what();
        if (includer != nullptr) throw SceneError(*includer, message);
        throw std::runtime_error(message);
    }
    Tokenizer tokens(scene_.sources.emplace_back(std::move(source)));
    Tokenizer* const outer = std::exchange(tokens_, &tokens);
    ++include_depth_;
    while (tokens.peek().kind != TokenKind::end) parse_directive(tokens.next());
    --include_depth_;
    tokens_ = outer;
}

void Parser::parse_directive(const Token& directive) {
    location_ = tokens_->location(directive);
    if (directive.kind != TokenKind::word)
        throw SceneError(location_, "expected a directive, found " + Tokenizer::describe(directive));
    const auto handler = handlers().find(directive.text);
    if (handler != handlers().end()) {
        (this->*handler->second)();
    } else {
        skip_unknown_directive(directive);
    }
}

void Parser::skip_unknown_directive(const Token& directive) {
    const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (!is_capital(directive.text.front()))
        throw SceneError(location_, "expected a directive, found " + Tokenizer::describe(directive));
    scene_.warnings.add(location_, "directive '" + std::string(directive.text) + "' is unknown and skipped");
    const auto is_argument = [&](const Token& token) {
        return token.kind != TokenKind::end &&
               (token.kind != TokenKind::word || !is_capital(token.text.front()));
    };
    while (is_argument(tokens_->peek())) tokens_->next();
}

// ---- Arguments
// ----------------------------------------------------------------------------------------------

std::string Parser::read_string() {
    const Token token = tokens_->next();
    if (token.kind != TokenKind::string)
        throw SceneError(tokens_->location(token),
                         "expected a quoted string, found " + Tokenizer::describe(token));
    return unescape(token.text);
}

double Parser::read_number() {
    const Token token = tokens_->next();
    if (token.kind != TokenKind::word)
        throw SceneError(tokens_->location(token), "expected a number, found " + Tokenizer::describe(token));
    return parse_number(token.text, tokens_->location(token));
}

Double3 Parser::read_vector() {
    const double x = read_number();
    const double y = read_number();
    const double z = read_number();
    return {x, y, z};
}

Transform Parser::read_matrix() {
    const auto read_bracket = [&](TokenKind kind, std::string_view text) {
        const Token token = tokens_->next();
        if (token.kind != kind)
            throw SceneError(tokens_->location(token), "expected '" + std::string(text) +
                                                           "' around 16 numbers, found " +
                                                           Tokenizer::describe(token));
    };
    const bool has_brackets = tokens_->peek().kind == TokenKind::open_bracket;
    if (has_brackets) read_bracket(TokenKind::open_bracket, "[");
    std::array<double, 16> entries{};
    for (double& entry : entries) entry = read_number();
    if (has_brackets) read_bracket(TokenKind::close_bracket, "]");
    return from_columns(entries);
}

std::filesystem::path Parser::resolve(const std::string& name) const {
    // pbrt looks beside the main file; beside the including file is what people expect.
    const std::filesystem::path beside_includer = location_.file->path.parent_path() / name;
    if (std::filesystem::exists(beside_includer)) return beside_includer;
    const std::filesystem::path beside_main = main_path_.parent_path() / name;
    return std::filesystem::exists(beside_main) ? beside_main : beside_includer;
}

// ---- Transforms and state
// -----------------------------------------------------------------------------------

void Parser::identity() { state_.current().ctm = {}; }
void Parser::translate() { concatenate(translation(read_vector())); }
void Parser::scale() { concatenate(scaling(read_vector())); }

void Parser::rotate() {
    const double degrees = read_number();
    const Double3 axis = read_vector();
    if (length(axis) == 0) throw SceneError(location_, "Rotate: the axis is zero");
    concatenate(rotation(degrees, axis));
}

void Parser::look_at_directive() {
    const Double3 eye = read_vector();
    const Double3 target = read_vector();
    const Double3 up = read_vector();
    const auto t = look_at(eye, target, up);
    if (!t) throw SceneError(location_, "LookAt: the viewing direction is zero or parallel to the up vector");
    concatenate(*t);
}

void Parser::transform() { state_.current().ctm = read_matrix(); }
void Parser::concat_transform() { concatenate(read_matrix()); }
void Parser::coordinate_system() { coordinate_systems_[read_string()] = state_.current().ctm; }

void Parser::coord_sys_transform() {
    const std::string name = read_string();
    const auto found = coordinate_systems_.find(name);
    if (found == coordinate_systems_.end())
        throw SceneError(location_, "coordinate system \"" + name + "\" is not defined");
    state_.current().ctm = found->second;
}

void Parser::active_transform() {
    const Token token = tokens_->next();
    if (token.text != "All")
        throw SceneError(location_,
                         "ActiveTransform " + std::string(token.text) +
                             ": moving objects are not supported, remove the transforms for one time");
}

void Parser::object_begin() {
    const std::string name = read_string();
    scene_.warnings.add(location_, "object instances",
                        "object instances are not supported: shapes of object \"" + name + "\" are left out");
    state_.push(StateBlock::object, location_);
    inside_object_ = true;
}

void Parser::object_end() {
    state_.pop(StateBlock::object, location_);
    inside_object_ = false;
}

void Parser::object_instance() { read_string(); }

void Parser::world_begin() {
    state_.current().ctm = {};
    coordinate_systems_["world"] = {};
}

void Parser::include() {
    const std::string name = read_string();
    const Location includer = location_;
    parse_file(resolve(name), &includer);
}

void Parser::import() {
    const Location begin = location_;
    state_.push(StateBlock::import, begin);
    include();
    state_.pop(StateBlock::import, begin);
}

// ---- Camera and film
// ----------------------------------------------------------------------------------------

void Parser::camera() {
    const std::string type = read_string();
    ParameterList parameters = read_parameters();
    camera_ = read_camera(type, parameters, state_.current().ctm, scene_.warnings);
    const auto world_from_camera = inverse(state_.current().ctm);
    if (world_from_camera) coordinate_systems_["camera"] = *world_from_camera;
}

void Parser::film() {
    const std::string type = read_string();
    ParameterList parameters = read_parameters();
    scene_.film = read_film(type, parameters, scene_.warnings);
}

void Parser::pixel_filter() {
    const std::string type = read_string();
    ParameterList parameters = read_parameters();
    // What v4 calls radius is called width in v3: half the size of the box in pixels.
    bool is_one_pixel = true;
    for (const std::string_view name : {"xradius", "yradius", "xwidth", "ywidth"})
        is_one_pixel = is_one_pixel && parameters.real(name, 0.5) == 0.5;
    if (type != "box" || !is_one_pixel)
        scene_.warnings.add(location_, "PixelFilter \"" + type + "\": a box of one pixel is used");
}

void Parser::ignore_with_parameters() {
    read_string();
    read_parameters();
}

// ---- Lights, materials, shapes
// ------------------------------------------------------------------------------

void Parser::light_source() {
    const std::string type = read_string();
    read_parameters();
    scene_.warnings.add(location_, "LightSource \"" + type + "\" is not supported and ignored");
}

void Parser::area_light_source() {
    const std::string type = read_string();
    ParameterList parameters = read_parameters();
    // pbrt v2's name for it.
    if (type != "diffuse" && type != "area") {
        scene_.warnings.add(location_, "AreaLightSource \"" + type + "\" is not supported and ignored");
        return;
    }
    const Float3 radiance = parameters.colour("L", {1, 1, 1}, scene_.warnings);
    // v3 also scales by a colour.
    const auto scale = static_cast<float>(parameters.real("scale", 1));
    const Float3 tint = parameters.colour("scale", {scale, scale, scale}, scene_.warnings);
    Emission emission;
    emission.radiance = {radiance.x * tint.x, radiance.y * tint.y, radiance.z * tint.z};
    emission.two_sided = parameters.boolean("twosided", false);
    for (const float value : {emission.radiance.x, emission.radiance.y, emission.radiance.z})
        if (!(value >= 0 && value <= std::numeric_limits<float>::max()))
            throw SceneError(location_, "AreaLightSource: radiance must be finite and not negative, found " +
                                            to_text(value));
    if (parameters.optional_real("power"))
        scene_.warnings.add(location_, "AreaLightSource: power is ignored, L and scale give the radiance");
    if (!parameters.string("filename", "").empty())
        scene_.warnings.add(location_, "AreaLightSource: images of emission are ignored, L is used");
    parameters.ignore({"samples", "nsamples", "xsamples", "ysamples"});
    parameters.warn_unused("AreaLightSource", scene_.warnings);
    state_.current().emission = emission;
}

MaterialEntry& Parser::add_material(const std::string& name, const std::string& type,
                                    ParameterList parameters) {
    MaterialDirective directive{name, type, std::move(parameters), {}};
    const std::string normal_map = directive.parameters.string("normalmap", "");
    if (!normal_map.empty()) directive.normal_map = resolve(normal_map);
    return materials_.emplace_back(MaterialEntry{std::move(directive), {}});
}

void Parser::material() {
    const std::string type = read_string();
    state_.current().material = &add_material(type, type, read_parameters());
}

void Parser::make_named_material() {
    const std::string name = read_string();
    ParameterList parameters = read_parameters();
    const std::string type = parameters.string("type", "matte");
    if (named_materials_.contains(name))
        scene_.warnings.add(location_,
                            "material \"" + name + "\" is defined again; the new one applies from here on");
    named_materials_[name] = &add_material(name, type, std::move(parameters));
}

void Parser::named_material() {
    const std::string name = read_string();
    const auto found = named_materials_.find(name);
    if (found == named_materials_.end())
        throw SceneError(location_, "material \"" + name + "\" is not defined");
    state_.current().material = found->second;
}

void Parser::texture() {
    TextureDirective directive;
    directive.name = read_string();
    const std::string type = read_string();
    directive.texture_class = read_string();
    directive.parameters = read_parameters();
    if (type != "float" && type != "spectrum" && type != "color")
        throw SceneError(location_, "texture \"" + directive.name +
                                        "\": expected type \"float\" or \"spectrum\", found \"" + type + '"');
    directive.type = type == "float" ? TextureType::number : TextureType::colour;
    directive.image_path = resolve(directive.parameters.string("filename", ""));
    textures_.define(directive, scene_.warnings);
}

int Parser::used_material(MaterialEntry& entry) {
    if (!entry.index) {
        const auto find_material = [&](const std::string& name) {
            const auto found = named_materials_.find(name);
            return found != named_materials_.end() ? &found->second->directive : nullptr;
        };
        const auto reduced = reduce_material(entry.directive, textures_, find_material, scene_.warnings);
        entry.index = reduced ? static_cast<int>(scene_.materials.size()) : kInvisible;
        if (reduced) scene_.materials.push_back(*reduced);
    }
    return *entry.index;
}

/// For lights on invisible surfaces.
int Parser::black_material() {
    if (!black_material_) {
        black_material_ = static_cast<int>(scene_.materials.size());
        Material black;
        black.name = "black";
        black.diffuse = {0, 0, 0};
        scene_.materials.push_back(black);
    }
    return *black_material_;
}

void Parser::shape() {
    ShapeDirective shape;
    shape.type = read_string();
    shape.parameters = read_parameters();
    if (inside_object_) return;
    const GraphicsState& state = state_.current();
    shape.world_from_object = state.ctm;
    shape.reverse_orientation = state.reverse_orientation;
    shape.emission = state.emission;
    if (!is_supported(shape)) {
        scene_.warnings.add(location_, "shape \"" + shape.type + "\" is not supported and left out");
        return;
    }
    if (shape.type == "plymesh") shape.mesh_path = resolve(shape.parameters.string("filename", ""));
    // Tubes are no surfaces, they need no material.
    if (!is_tube(shape.type)) {
        shape.material = used_material(*state.material);
        if (shape.material == kInvisible && is_black(shape.emission.radiance)) return;
        if (shape.material == kInvisible) shape.material = black_material();
        shape.material = alpha_variants_.material(shape.material, shape.parameters, textures_,
                                                  scene_.materials, scene_.warnings);
    }
    scene_.shapes.push_back(std::move(shape));
}

} // namespace

SceneDescription parse_scene(const std::filesystem::path& path) { return Parser(path).run(); }

} // namespace nusselt::scene
