#include "scene/import/pbrt/parser.h"

#include "scene/build/textures/surface_formula.h"
#include "scene/import/pbrt/directives/camera_directive.h"
#include "scene/import/pbrt/directives/emission_directive.h"
#include "scene/import/pbrt/directives/film_directive.h"
#include "scene/import/pbrt/directives/light_source_directive.h"
#include "scene/import/pbrt/directives/option_directive.h"
#include "scene/import/pbrt/directives/sampler_directive.h"
#include "scene/import/pbrt/graphics_state.h"
#include "scene/import/pbrt/materials.h"
#include "scene/import/pbrt/objects.h"
#include "scene/import/pbrt/surface_variants.h"
#include "scene/import/pbrt/syntax/source_reader.h"
#include "scene/import/pbrt/syntax/type_counter.h"
#include "scene/import/pbrt/textures.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace nusselt::scene {

namespace {

struct FilterDirective {
    std::string type;
    ParameterList parameters;
};

class Parser {
public:
    explicit Parser(const std::filesystem::path& main_path)
        : reader_(main_path, scene_.sources, *scene_.budget, scene_.named_files) {
        scene_.words = {"ObjectInstance", "AreaLightSource", "ReverseOrientation"};
        materials_.push_back({{"default", "matte", ParameterList(), {}}, {}});
        state_.current().material = &materials_.back();
    }

    SceneDescription run();

private:
    enum class Place { anywhere, before_world, in_world };
    struct Directive {
        void (Parser::*read)();
        Place place = Place::anywhere;
    };

    static const std::unordered_map<std::string_view, Directive>& directives();

    void parse_file();
    void parse_directive(const Token& directive);
    /// Warns of what pbrt does not accept here.
    void check_place(std::string_view directive, Place place);
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
    void transform_times();
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
    void attribute();
    void world_begin();
    void world_end() { world_end_ = true; }
    void include();
    void import();
    void camera();
    void film();
    void pixel_filter();
    void sampler();
    void ignore_with_parameters();
    void option();
    void ignore_medium();
    void medium_interface();
    void color_space();
    void light_source();
    void area_light_source();
    void material();
    void make_named_material();
    void named_material();
    void texture();
    void shape();

    std::string read_string() { return reader_.read_string(); }
    ParameterContext context() {
        return {version_,
                state_.current().colour_space,
                &reader_.main_file(),
                scene_.budget.get(),
                &scene_.named_files,
                nullptr};
    }
    ParameterList read_parameters() { return {reader_.tokens(), location_, context()}; }
    /// Reads parameters, with the defaults that Attribute directives set.
    ParameterList read_parameters(AttributeTarget target);
    std::filesystem::path resolve(const std::string& name) const { return reader_.resolve(name, location_); }
    void concatenate(const Transform& t) { set_transform(state_.current().ctm * t); }
    void set_transform(const Transform& t);
    MaterialEntry& add_material(const std::string& name, const std::string& type, ParameterList parameters);
    int used_material(MaterialEntry& entry);
    int invisible_light_material();

    SceneDescription scene_;
    SourceReader reader_;
    StateStack state_;
    std::deque<MaterialEntry> materials_;
    std::unordered_map<std::string, MaterialEntry*> named_materials_;
    std::unordered_map<std::string, Transform> coordinate_systems_;
    std::optional<int> invisible_light_material_;
    TextureTable textures_;
    SurfaceVariants surface_variants_;
    EmissionFiles emission_files_;
    TypeCounter left_out_shapes_;
    ObjectTable objects_;
    TypeCounter ignored_lights_;
    std::optional<CameraDescription> camera_;
    bool has_moved_camera_ = false; ///< whether its transform is not the identity
    std::optional<FilterDirective> pixel_filter_;
    std::optional<int> pixel_samples_;
    std::optional<Location> world_begin_;
    bool world_end_ = false;
    PbrtVersion version_ = PbrtVersion::v4; ///< until the film determines it

    Location location_;             ///< of the directive that is being read
    bool knows_directives_ = false; ///< whether the files have a directive that is known
};

const std::unordered_map<std::string_view, Parser::Directive>& Parser::directives() {
    static const std::unordered_map<std::string_view, Directive> kDirectives = {
        {"Identity", {&Parser::identity}},
        {"Translate", {&Parser::translate}},
        {"Scale", {&Parser::scale}},
        {"Rotate", {&Parser::rotate}},
        {"LookAt", {&Parser::look_at_directive}},
        {"Transform", {&Parser::transform}},
        {"ConcatTransform", {&Parser::concat_transform}},
        {"CoordinateSystem", {&Parser::coordinate_system}},
        {"CoordSysTransform", {&Parser::coord_sys_transform}},
        {"TransformTimes", {&Parser::transform_times}},
        {"ReverseOrientation", {&Parser::reverse_orientation}},
        {"ActiveTransform", {&Parser::active_transform}},
        {"AttributeBegin", {&Parser::attribute_begin}},
        {"AttributeEnd", {&Parser::attribute_end}},
        {"TransformBegin", {&Parser::transform_begin}},
        {"TransformEnd", {&Parser::transform_end}},
        {"ObjectBegin", {&Parser::object_begin, Place::in_world}},
        {"ObjectEnd", {&Parser::object_end}},
        {"ObjectInstance", {&Parser::object_instance, Place::in_world}},
        {"Attribute", {&Parser::attribute}},
        {"WorldBegin", {&Parser::world_begin}},
        {"WorldEnd", {&Parser::world_end}},
        {"Include", {&Parser::include}},
        {"Import", {&Parser::import}},
        {"Camera", {&Parser::camera, Place::before_world}},
        {"Film", {&Parser::film, Place::before_world}},
        {"PixelFilter", {&Parser::pixel_filter, Place::before_world}},
        {"Sampler", {&Parser::sampler, Place::before_world}},
        {"Integrator", {&Parser::ignore_with_parameters, Place::before_world}},
        {"SurfaceIntegrator", {&Parser::ignore_with_parameters, Place::before_world}},
        {"Renderer", {&Parser::ignore_with_parameters, Place::before_world}},
        {"Accelerator", {&Parser::ignore_with_parameters, Place::before_world}},
        {"ColorSpace", {&Parser::color_space}},
        {"Option", {&Parser::option}},
        {"MakeNamedMedium", {&Parser::ignore_medium}},
        {"MediumInterface", {&Parser::medium_interface}},
        {"LightSource", {&Parser::light_source, Place::in_world}},
        {"AreaLightSource", {&Parser::area_light_source, Place::in_world}},
        {"Material", {&Parser::material}},
        {"MakeNamedMaterial", {&Parser::make_named_material}},
        {"NamedMaterial", {&Parser::named_material}},
        {"Texture", {&Parser::texture}},
        {"Shape", {&Parser::shape, Place::in_world}},
    };
    return kDirectives;
}

SceneDescription Parser::run() {
    coordinate_systems_["world"] = {};
    try {
        parse_file();
    } catch (const SceneError&) {
        // What is wrong may be a consequence of a missing file, such as a material that it defines.
        scene_.named_files.report_missing();
        throw;
    }
    if (!knows_directives_)
        throw SceneError({&scene_.sources.front(), 1},
                         "none of the directives of pbrt's format is in this file; is it a scene?");
    state_.warn_if_open(scene_.warnings);
    left_out_shapes_.warn("unsupported shapes are skipped, starting here", scene_.warnings);
    ignored_lights_.warn("unsupported light sources are skipped, starting here", scene_.warnings);
    const Location begin{&scene_.sources.front(), 1};
    if (!camera_)
        scene_.warnings.add(begin, "Camera is missing; the default camera looks from the origin along +z");
    if (!camera_) camera_.emplace().origin = begin;
    scene_.camera = *camera_;
    scene_.textures = textures_.planner().plan();
    if (pixel_filter_)
        scene_.film.filter =
            read_pixel_filter(pixel_filter_->type, pixel_filter_->parameters, version_, scene_.warnings);
    scene_.film.pixel_samples = pixel_samples_;
    scene_.objects = objects_.take_objects();
    scene_.instances = objects_.take_instances();
    // All is read: only the paths of the files are still needed, for messages.
    for (SourceFile& source : scene_.sources) source.bytes = {};
    return std::move(scene_);
}

void Parser::parse_file() {
    while (reader_.tokens().peek().kind != TokenKind::end) {
        parse_directive(reader_.tokens().next());
        reader_.release_text();
    }
}

void Parser::parse_directive(const Token& directive) {
    location_ = reader_.tokens().location(directive);
    if (directive.kind != TokenKind::word)
        throw SceneError(location_, "expected a directive, found " + Tokenizer::describe(directive));
    const auto found = directives().find(directive.text);
    if (found == directives().end()) return skip_unknown_directive(directive);
    knows_directives_ = true;
    check_place(directive.text, found->second.place);
    (this->*found->second.read)();
}

void Parser::check_place(std::string_view directive, Place place) {
    if (place == Place::before_world && world_begin_)
        scene_.warnings.add(location_, "directives that belong before WorldBegin",
                            std::string(directive) +
                                " belongs before WorldBegin; it replaces an earlier one");
    if (place == Place::in_world && has_moved_camera_ && !world_begin_)
        scene_.warnings.add(location_, "directives that belong behind WorldBegin",
                            std::string(directive) +
                                " belongs behind WorldBegin; transforms such as that of the "
                                "camera apply to it");
    if (place == Place::in_world && world_end_)
        scene_.warnings.add(location_, "directives behind WorldEnd",
                            std::string(directive) +
                                " is behind WorldEnd; it is part of the scene nevertheless");
}

void Parser::skip_unknown_directive(const Token& directive) {
    const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (!is_capital(directive.text.front()))
        throw SceneError(location_, "expected a directive, found " + Tokenizer::describe(directive));
    scene_.warnings.add(location_, "directive '" + shortened(directive.text) + "' is unknown and ignored");
    const auto is_argument = [&](const Token& token) {
        return token.kind != TokenKind::end &&
               (token.kind != TokenKind::word || !is_capital(token.text.front()));
    };
    while (is_argument(reader_.tokens().peek())) reader_.tokens().next();
}

ParameterList Parser::read_parameters(AttributeTarget target) {
    ParameterContext context = this->context();
    context.defaults = state_.current().defaults[static_cast<std::size_t>(target)];
    return {reader_.tokens(), location_, std::move(context)};
}

// ---- Transforms and state

void Parser::set_transform(const Transform& t) {
    if (state_.current().moves_begin) {
        state_.current().ctm = t;
    } else {
        scene_.warnings.add(location_, "motion",
                            "motion is not supported; transforms for EndTime alone are ignored");
    }
}

void Parser::identity() { set_transform({}); }
void Parser::translate() { concatenate(translation(reader_.read_vector())); }
void Parser::scale() { concatenate(scaling(reader_.read_vector())); }

void Parser::rotate() {
    const double degrees = reader_.read_number();
    const Double3 axis = reader_.read_vector();
    if (length(axis) == 0) throw SceneError(location_, "Rotate: the axis is zero");
    concatenate(rotation(degrees, axis));
}

void Parser::look_at_directive() {
    const Double3 eye = reader_.read_vector();
    const Double3 target = reader_.read_vector();
    const Double3 up = reader_.read_vector();
    const auto t = look_at(eye, target, up);
    if (!t) throw SceneError(location_, "LookAt: the viewing direction is zero or parallel to the up vector");
    concatenate(*t);
}

void Parser::transform() { set_transform(reader_.read_matrix()); }
void Parser::concat_transform() { concatenate(reader_.read_matrix()); }
void Parser::coordinate_system() { coordinate_systems_[read_string()] = state_.current().ctm; }

void Parser::coord_sys_transform() {
    const std::string name = read_string();
    const auto found = coordinate_systems_.find(name);
    if (found == coordinate_systems_.end())
        throw SceneError(location_, "coordinate system \"" + shortened(name) + "\" is not defined");
    state_.current().ctm = found->second;
}

void Parser::transform_times() {
    reader_.read_number();
    reader_.read_number();
}

void Parser::active_transform() {
    const Token token = reader_.tokens().next();
    if (token.text != "All" && token.text != "StartTime" && token.text != "EndTime")
        throw SceneError(location_, "ActiveTransform: expected All, StartTime or EndTime, found " +
                                        Tokenizer::describe(token));
    state_.current().moves_begin = token.text != "EndTime";
}

void Parser::object_begin() {
    const std::string name = read_string();
    objects_.begin(name, location_, scene_.warnings);
    state_.push(StateBlock::object, location_);
}

void Parser::object_end() {
    state_.pop(StateBlock::object, location_);
    objects_.end();
}

void Parser::object_instance() {
    objects_.add_instance(read_string(), state_.current().ctm, location_, scene_.words);
}

void Parser::option() { read_option(read_string(), location_, reader_.tokens(), scene_.warnings); }

void Parser::attribute() {
    const std::string name = read_string();
    const ParameterList parameters = read_parameters();
    const auto target = std::find(kAttributeTargets.begin(), kAttributeTargets.end(), name);
    if (target == kAttributeTargets.end())
        throw SceneError(location_,
                         "Attribute \"" + shortened(name) +
                             "\": expected \"shape\", \"light\", \"material\", \"texture\" or \"medium\"");
    auto& defaults = state_.current().defaults[static_cast<std::size_t>(target - kAttributeTargets.begin())];
    auto all = parameters.appended_to(defaults != nullptr ? *defaults : std::vector<Parameter>{});
    constexpr std::size_t kMaxDefaults = 64;
    if (all.size() > kMaxDefaults)
        throw SceneError(location_, "Attribute \"" + name + "\": more than " + std::to_string(kMaxDefaults) +
                                        " parameters; enclose them in AttributeBegin and AttributeEnd");
    defaults = std::make_shared<const std::vector<Parameter>>(std::move(all));
}

void Parser::world_begin() {
    if (world_begin_)
        throw SceneError(location_, "second WorldBegin; the first one is at " + to_string(*world_begin_) +
                                        "; split the file into one world each");
    world_begin_ = location_;
    state_.current().ctm = {};
    state_.current().moves_begin = true;
    coordinate_systems_["world"] = {};
}

void Parser::include() {
    if (!reader_.open(read_string(), location_)) return;
    parse_file();
    reader_.close();
}

void Parser::import() {
    const Location begin = location_;
    state_.push(StateBlock::import, begin);
    include();
    state_.pop(StateBlock::import, begin);
}

// ---- Camera and film

void Parser::camera() {
    const std::string type = reader_.read_type();
    ParameterList parameters = read_parameters();
    camera_ = read_camera(type, parameters, state_.current().ctm, scene_.warnings);
    has_moved_camera_ = !is_identity(state_.current().ctm);
    const auto world_from_camera = inverse(state_.current().ctm);
    if (world_from_camera) coordinate_systems_["camera"] = *world_from_camera;
}

void Parser::film() {
    const std::string type = reader_.read_type();
    ParameterList parameters = read_parameters();
    scene_.film = read_film(type, parameters, scene_.warnings);
    version_ = type == "image" ? PbrtVersion::v3 : PbrtVersion::v4;
}

/// Its defaults depend on the version, which the film may determine later.
void Parser::pixel_filter() {
    std::string type = reader_.read_type();
    pixel_filter_ = {std::move(type), read_parameters()};
}

void Parser::sampler() {
    const std::string type = reader_.read_type();
    ParameterList parameters = read_parameters();
    pixel_samples_ = read_pixel_samples(type, parameters, scene_.warnings);
}

void Parser::ignore_with_parameters() {
    reader_.read_type();
    read_parameters();
}

// ---- Lights, materials, shapes

void Parser::ignore_medium() {
    ignore_with_parameters();
    scene_.warnings.add(location_, "media", "participating media are not supported and ignored");
}

void Parser::medium_interface() {
    read_string();
    // v3 allows one name for both sides.
    if (reader_.tokens().peek().kind == TokenKind::string) read_string();
    scene_.warnings.add(location_, "media", "participating media are not supported and ignored");
}

void Parser::color_space() {
    const std::string name = read_string();
    const ColourSpace* const space = find_colour_space(name);
    if (space == nullptr)
        throw SceneError(location_,
                         "ColorSpace \"" + shortened(name) +
                             "\" is unknown; use \"srgb\", \"dci-p3\", \"rec2020\" or \"aces2065-1\"");
    state_.current().colour_space = space;
}

void Parser::light_source() {
    LightSourceDirective light;
    light.type = reader_.read_type();
    light.parameters = read_parameters(AttributeTarget::light);
    if (!is_supported_light_source(light.type)) {
        ignored_lights_.add(light.type, location_);
        return;
    }
    light.world_from_light = state_.current().ctm;
    light.version = version_;
    light.resolve = [this](const std::string& name) { return resolve(name); };
    if (auto source =
            read_light_source(light, textures_.planner(), emission_files_.luminaires, scene_.warnings))
        scene_.light_sources.push_back(std::move(*source));
}

void Parser::area_light_source() {
    const std::string type = reader_.read_type();
    ParameterList parameters = read_parameters(AttributeTarget::light);
    const auto path_of = [&](std::string_view parameter) {
        const std::string name = parameters.string(parameter, "");
        return name.empty() ? std::filesystem::path() : resolve(name);
    };
    const EmissionPaths paths{path_of("filename"), path_of("ies")};
    state_.current().emission = read_emission(type, parameters, paths, emission_files_, scene_.warnings);
}

MaterialEntry& Parser::add_material(const std::string& name, const std::string& type,
                                    ParameterList parameters) {
    MaterialDirective directive{name, type, std::move(parameters), {}};
    const std::string normal_map = directive.parameters.string("normalmap", "");
    if (!normal_map.empty()) directive.normal_map = resolve(normal_map);
    return materials_.emplace_back(MaterialEntry{std::move(directive), {}});
}

void Parser::material() {
    const std::string type = reader_.read_type();
    state_.current().material = &add_material(type, type, read_parameters(AttributeTarget::material));
}

void Parser::make_named_material() {
    const std::string name = read_string();
    ParameterList parameters = read_parameters(AttributeTarget::material);
    const std::string type = parameters.string("type", "matte");
    if (named_materials_.contains(name))
        scene_.warnings.add(location_, "material \"" + shortened(name) +
                                           "\" is defined again; the new one applies from here on");
    named_materials_[name] = &add_material(name, type, std::move(parameters));
}

void Parser::named_material() {
    const std::string name = read_string();
    const auto found = named_materials_.find(name);
    if (found == named_materials_.end())
        throw SceneError(location_, "material \"" + shortened(name) + "\" is not defined");
    state_.current().material = found->second;
}

void Parser::texture() {
    TextureDirective directive;
    directive.name = read_string();
    const std::string type = reader_.read_type();
    directive.texture_class = read_string();
    directive.parameters = read_parameters(AttributeTarget::texture);
    if (type != "float" && type != "spectrum" && type != "color")
        throw SceneError(location_, "texture \"" + shortened(directive.name) +
                                        "\": expected type \"float\" or \"spectrum\", found \"" +
                                        shortened(type) + '"');
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

/// The material for lights on invisible surfaces.
int Parser::invisible_light_material() {
    if (!invisible_light_material_) {
        invisible_light_material_ = static_cast<int>(scene_.materials.size());
        scene_.materials.push_back(black_material());
    }
    return *invisible_light_material_;
}

void Parser::shape() {
    ShapeDirective shape;
    shape.type = reader_.read_type();
    shape.parameters = read_parameters(AttributeTarget::shape);
    const GraphicsState& state = state_.current();
    shape.world_from_object = state.ctm;
    shape.reverse_orientation = state.reverse_orientation;
    shape.emission = state.emission;
    if (!is_supported(shape.type)) {
        left_out_shapes_.add(shape.type, location_);
        return;
    }
    if (shape.type == "plymesh") shape.mesh_path = resolve(shape.parameters.string("filename", ""));
    if (is_surface(shape)) {
        shape.material = used_material(*state.material);
        if (shape.material == kInvisible && is_black(shape.emission.radiance)) return;
        if (shape.material == kInvisible) shape.material = invisible_light_material();
        shape.material =
            surface_variants_.material(shape.material, shape, textures_, scene_.materials, scene_.warnings);
    }
    if (objects_.is_open())
        objects_.add_shape(std::move(shape));
    else
        scene_.add_shape(read_shape(shape));
}

} // namespace

SceneDescription read_pbrt(const std::filesystem::path& path) { return Parser(path).run(); }

bool looks_like_pbrt(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::size_t word = bytes.find_first_not_of(" \t\r\n");
        if (word == std::string_view::npos) return false;
        if (bytes[word] != '#') return bytes[word] >= 'A' && bytes[word] <= 'Z';
        bytes.remove_prefix(std::min(bytes.find('\n', word), bytes.size()));
    }
    return false;
}

} // namespace nusselt::scene
