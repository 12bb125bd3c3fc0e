#include "scene/import/pbrt/textures.h"

#include <algorithm>
#include <iterator>

namespace nusselt::scene {

namespace {

std::string text_of(const TextureDirective& directive) { return "texture \"" + directive.name + '"'; }
std::string class_of(const TextureDirective& directive) {
    return "Texture \"" + directive.texture_class + '"';
}

TextureMapping read_mapping(TextureDirective& directive, Warnings& warnings) {
    ParameterList& parameters = directive.parameters;
    if (const std::string kind = parameters.string("mapping", "uv"); kind != "uv") {
        warnings.add(parameters.location_of("mapping"), "texture mapping " + kind,
                     text_of(directive) + ": mapping \"" + kind +
                         "\" is not supported; the texture coordinates of the mesh replace it");
        parameters.ignore({"v1", "v2"});
    }
    TextureMapping mapping;
    mapping.scale = {static_cast<float>(parameters.real("uscale", 1)),
                     static_cast<float>(parameters.real("vscale", 1))};
    mapping.offset = {static_cast<float>(parameters.real("udelta", 0)),
                      static_cast<float>(parameters.real("vdelta", 0))};
    return mapping;
}

ImageRequest::Encoding read_encoding(TextureDirective& directive) {
    ParameterList& parameters = directive.parameters;
    const bool has_gamma = parameters.boolean("gamma", true);
    const std::string encoding = parameters.string("encoding", has_gamma ? "sRGB" : "linear");
    if (encoding == "linear") return ImageRequest::kLinear;
    if (encoding == "sRGB") return ImageRequest::kSrgb;
    const Location location = parameters.location_of("encoding");
    constexpr std::string_view kGamma = "gamma ";
    const double gamma =
        encoding.starts_with(kGamma) ? parse_number(encoding.substr(kGamma.size()), location) : 0;
    if (!(gamma >= 0.1 && gamma <= 10))
        throw SceneError(location, text_of(directive) +
                                       ": encoding must be \"sRGB\", \"linear\" or \"gamma G\" with "
                                       "G from 0.1 to 10, found \"" +
                                       encoding + '"');
    return gamma;
}

TextureWrap read_wrap(TextureDirective& directive, Warnings& warnings) {
    const std::string wrap = directive.parameters.string("wrap", "repeat");
    if (wrap == "clamp") return TextureWrap::clamp;
    if (wrap == "black") return TextureWrap::black;
    if (wrap != "repeat")
        warnings.add(directive.parameters.location_of("wrap"),
                     text_of(directive) + ": wrap \"" + wrap + "\" is not supported; \"repeat\" replaces it");
    return TextureWrap::repeat;
}

/// A procedure of pbrt that is replaced by its mean.
struct Procedure {
    std::string_view texture_class;
    Float3 mean;
};
constexpr Procedure kProcedures[] = {
    {"fbm", {0.5f, 0.5f, 0.5f}}, {"wrinkled", {0.5f, 0.5f, 0.5f}},  {"windy", {0.5f, 0.5f, 0.5f}},
    {"uv", {0.5f, 0.5f, 0}},     {"marble", {0.80f, 0.79f, 0.83f}},
};

/// The share of the surface that "dots" cover: half of the cells have a disk of radius 0.35.
constexpr double kDotCoverage = 0.19;

} // namespace

TextureValue TextureTable::linear_image(const std::filesystem::path& path, const Location& location) {
    TextureNode node;
    node.operation = TextureOperation::image;
    node.image = planner_.image({path, ImageRequest::kLinear, location});
    return formulas().add(node);
}

const TextureValue& TextureTable::value(const std::string& name, TextureType type,
                                        const Location& location) const {
    const TextureType other = type == TextureType::number ? TextureType::colour : TextureType::number;
    for (const TextureType candidate : {type, other}) {
        const auto found = values_.find({candidate, name});
        if (found != values_.end()) return found->second;
    }
    throw SceneError(location, "texture \"" + name + "\" is not defined");
}

TextureValue TextureTable::input(TextureDirective& directive, std::string_view name, float fallback,
                                 Warnings& warnings) const {
    ParameterList& parameters = directive.parameters;
    if (const auto texture = parameters.texture(name))
        return value(*texture, directive.type, parameters.location_of(name));
    const TextureValue number = grey_value(parameters.optional_real(name).value_or(fallback));
    return {parameters.colour(name, number.factor, warnings), -1};
}

TextureValue TextureTable::reduce_image(TextureDirective& directive, Warnings& warnings) {
    ParameterList& parameters = directive.parameters;
    if (parameters.string("filename", "").empty())
        throw SceneError(parameters.location(),
                         text_of(directive) + ": parameter \"string filename\" is missing");
    TextureNode node;
    node.operation = TextureOperation::image;
    node.image =
        planner_.image({directive.image_path, read_encoding(directive), parameters.location_of("filename")});
    node.wrap = read_wrap(directive, warnings);
    if (parameters.string("filter", "bilinear") == "point") node.filter = TextureFilter::nearest;
    node.is_grey = directive.type == TextureType::number;
    node.mapping = read_mapping(directive, warnings);
    // Pixels have no footprint here.
    parameters.ignore({"trilinear", "maxanisotropy"});

    const double scale = parameters.real("scale", 1);
    const TextureValue scaled = formulas().product(grey_value(scale), formulas().add(node));
    return parameters.boolean("invert", false) ? formulas().inverted(scaled) : scaled;
}

TextureValue TextureTable::reduce_scale(TextureDirective& directive, Warnings& warnings) {
    TextureValue result;
    // v3 multiplies tex1 and tex2, v4 tex and scale.
    for (const std::string_view name : {"tex1", "tex2", "tex", "scale"})
        result = formulas().product(result, input(directive, name, 1, warnings));
    return result;
}

TextureValue TextureTable::reduce_mix(TextureDirective& directive, const TextureValue& amount,
                                      Warnings& warnings) {
    const TextureValue a = input(directive, "tex1", 0, warnings);
    const TextureValue b = input(directive, "tex2", 1, warnings);
    return formulas().mix(a, b, amount);
}

TextureValue TextureTable::reduce_checkerboard(TextureDirective& directive, Warnings& warnings) {
    const TextureValue a = input(directive, "tex1", 1, warnings);
    const TextureValue b = input(directive, "tex2", 0, warnings);
    directive.parameters.ignore({"aamode"});
    const TextureMapping mapping = read_mapping(directive, warnings);
    if (directive.parameters.integer("dimension", 2) == 2) return formulas().checkerboard(a, b, mapping);
    warnings.add(directive.parameters.location(),
                 class_of(directive) + ": not supported in three dimensions; its mean replaces it");
    return formulas().mix(a, b, grey_value(0.5));
}

TextureValue TextureTable::reduce_procedure(TextureDirective& directive, Warnings& warnings) {
    const auto* const found =
        std::find_if(std::begin(kProcedures), std::end(kProcedures), [&](const Procedure& procedure) {
            return procedure.texture_class == directive.texture_class;
        });
    const bool is_known = found != std::end(kProcedures);
    warnings.add(directive.parameters.location(), class_of(directive) + ": not supported; " +
                                                      (is_known ? "its mean" : "the grey 0.5") +
                                                      " replaces it");
    return is_known ? TextureValue{found->mean, -1} : grey_value(0.5);
}

TextureValue TextureTable::reduce(TextureDirective& directive, Warnings& warnings) {
    const std::string& kind = directive.texture_class;
    const auto warn_mean = [&] {
        warnings.add(directive.parameters.location(),
                     class_of(directive) + ": not supported; its mean replaces it");
    };
    if (kind == "imagemap") return reduce_image(directive, warnings);
    if (kind == "constant") return input(directive, "value", 1, warnings);
    if (kind == "scale") return reduce_scale(directive, warnings);
    if (kind == "mix") return reduce_mix(directive, input(directive, "amount", 0.5f, warnings), warnings);
    if (kind == "checkerboard") return reduce_checkerboard(directive, warnings);
    if (kind == "directionmix") {
        warn_mean();
        directive.parameters.ignore({"dir"});
        return reduce_mix(directive, grey_value(0.5), warnings);
    }
    if (kind == "dots") {
        warn_mean();
        read_mapping(directive, warnings);
        const TextureValue outside = input(directive, "outside", 0, warnings);
        return formulas().mix(outside, input(directive, "inside", 1, warnings), grey_value(kDotCoverage));
    }
    if (kind == "bilerp") {
        warn_mean();
        read_mapping(directive, warnings);
        const TextureValue v00 = input(directive, "v00", 0, warnings);
        const TextureValue v01 = input(directive, "v01", 1, warnings);
        const TextureValue v10 = input(directive, "v10", 0, warnings);
        const TextureValue v11 = input(directive, "v11", 1, warnings);
        const TextureValue half = grey_value(0.5);
        return formulas().mix(formulas().mix(v00, v01, half), formulas().mix(v10, v11, half), half);
    }
    const TextureValue replacement = reduce_procedure(directive, warnings);
    // Parameters of a replaced texture cause no further warnings.
    directive.parameters = {};
    return replacement;
}

void TextureTable::define(TextureDirective& directive, Warnings& warnings) {
    const TextureValue value = reduce(directive, warnings);
    values_[{directive.type, directive.name}] = value;
    directive.parameters.warn_unused(class_of(directive), warnings);
}

} // namespace nusselt::scene
