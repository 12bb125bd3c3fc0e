#include "scene/import/pbrt/material_reader.h"

#include "scene/import/pbrt/syntax/named_spectra.h"
#include "scene/model/vector_math.h"

#include <cmath>

namespace nusselt::scene {

namespace {

/// The optical constant of a spectrum known by name.
Float3 optical_constant(std::string_view name) { return to_float(named_spectrum(name).value()); }

} // namespace

SurfaceFormula metallic(const TextureValue& f0, const TextureValue& roughness) {
    SurfaceFormula surface;
    surface.model = BrdfModel::frostbite;
    surface.f0 = f0;
    surface.roughness = roughness;
    return surface;
}

TextureValue MaterialReader::value(std::string_view name, TextureType type, const Float3& fallback) {
    if (const auto texture = parameters().texture(name))
        return textures_.value(*texture, type, parameters().location_of(name));
    if (type == TextureType::number)
        return grey_value(parameters().real(name, static_cast<double>(fallback.x)));
    return {parameters().colour(name, fallback, warnings_), -1};
}

TextureValue MaterialReader::checked(std::string_view name, TextureValue value) {
    bool is_clamped = false;
    for (float* channel : {&value.factor.x, &value.factor.y, &value.factor.z}) {
        if (!(*channel >= 0))
            fail(name, std::string(name) + " must not be negative, found " + to_text(*channel));
        if (value.node >= 0 || *channel <= 1) continue;
        *channel = 1;
        is_clamped = true;
    }
    if (is_clamped) warn(std::string(name) + " above 1 is clamped to 1");
    return value;
}

TextureValue MaterialReader::unit_colour(std::string_view name, const Float3& fallback) {
    return checked(name, value(name, TextureType::colour, fallback));
}

TextureValue MaterialReader::unit_number(std::string_view name, double fallback) {
    return checked(name, number(name, fallback));
}

TextureValue MaterialReader::number(std::string_view name, double fallback) {
    return value(name, TextureType::number, grey_value(fallback).factor);
}

Float3 MaterialReader::constant_colour(std::string_view name, const Float3& fallback) {
    const TextureValue result = value(name, TextureType::colour, fallback);
    if (result.node < 0) return result.factor;
    warn_image(name);
    return fallback;
}

double MaterialReader::constant(std::string_view name, double fallback) {
    if (!parameters().texture(name)) return parameters().real(name, fallback);
    const TextureValue result = number(name, fallback);
    if (result.node < 0) return static_cast<double>(result.factor.x);
    warn_image(name);
    return fallback;
}

double MaterialReader::refractive_index(std::string_view name, double fallback) {
    const auto colour = parameters().optional_colour(name, warnings_);
    const double result = colour ? luminance(to_double(*colour)) : constant(name, fallback);
    if (!(result > 0)) fail(name, std::string(name) + " must be positive, found " + to_text(result));
    return result;
}

bool MaterialReader::has_colour(std::string_view name) {
    return parameters().texture(name) || parameters().optional_colour(name, warnings_);
}

TextureValue MaterialReader::roughness(double fallback, RoughnessRule remapped, const std::string& prefix) {
    const TextureValue both = number(prefix + "roughness", fallback);
    const auto direction = [&](const std::string& name) {
        return parameters().texture(name) || parameters().optional_real(name) ? number(name, 0) : both;
    };
    const TextureValue u = direction(prefix + "uroughness");
    const TextureValue v = direction(prefix + "vroughness");
    for (const TextureValue& r : {u, v})
        if (!(r.factor.x >= 0))
            fail(prefix + "roughness", "roughness must not be negative, found " + to_text(r.factor.x));
    const bool remap = parameters().boolean("remaproughness", true);
    const RoughnessRule rule = remap ? remapped : RoughnessRule::alpha;
    if (u.node == v.node && u.factor.x == v.factor.x) return formulas().roughness(u, rule);
    if (u.node >= 0 || v.node >= 0) {
        warn("anisotropic roughness with images is replaced by that along u");
        return formulas().roughness(u, rule);
    }
    warn("anisotropic roughness is replaced by its geometric mean");
    // Perfectly smooth along one direction only is no special case.
    const auto alpha = [rule](float r) {
        constexpr double kNearlyZero = 1e-9;
        return alpha_from_roughness(std::max(static_cast<double>(r), kNearlyZero), rule);
    };
    return grey_value(roughness_from_alpha(std::sqrt(alpha(u.factor.x) * alpha(v.factor.x))));
}

TextureValue MaterialReader::conductor(const std::string& prefix, double coat_eta) {
    const Float3 eta = constant_colour(prefix + "eta", optical_constant("metal-Cu-eta"));
    const Float3 k = constant_colour(prefix + "k", optical_constant("metal-Cu-k"));
    const auto f0 = [coat_eta](float n, float extinction) {
        return coated_conductor_f0(static_cast<double>(n), static_cast<double>(extinction), coat_eta);
    };
    return {to_float({f0(eta.x, k.x), f0(eta.y, k.y), f0(eta.z, k.z)}), -1};
}

void MaterialReader::warn(std::string_view message) {
    warnings_.add(parameters().location(), "material " + directive_.type + ' ' + std::string(message),
                  "material \"" + directive_.type + "\": " + std::string(message));
}

void MaterialReader::warn_ignored(std::initializer_list<std::string_view> numbers) {
    for (const std::string_view name : numbers) {
        const TextureValue given = number(name, 0);
        if (given.node >= 0 || given.factor.x != 0) warn(std::string(name) + " is ignored");
    }
}

void MaterialReader::warn_image(std::string_view name) {
    warnings_.add(parameters().location_of(name), "material image " + std::string(name),
                  "material \"" + directive_.name + "\": an image for \"" + std::string(name) +
                      "\" is not supported; its default replaces it");
}

void MaterialReader::fail(std::string_view parameter, const std::string& message) const {
    throw SceneError(directive_.parameters.location_of(parameter),
                     "material \"" + directive_.name + "\": " + message);
}

} // namespace nusselt::scene
