#include "scene/import/pbrt/materials.h"

#include "scene/import/pbrt/material_reader.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace nusselt::scene {

namespace {

/// Mixtures of mixtures are at most this deep; more, and they refer to themselves.
constexpr int kMaxMixtureDepth = 8;

/// The weight of the roughness of `b` where only one can be.
TextureValue roughness_share(const SurfaceFormula& a, const SurfaceFormula& b, const TextureValue& amount) {
    const double reflectance_a = mean(a.f0.factor);
    const double reflectance_b = mean(b.f0.factor);
    if (reflectance_a == 0 || reflectance_b == 0) return grey_value(reflectance_b == 0 ? 0 : 1);
    if (amount.node >= 0) return amount;
    const double share = std::clamp(mean(amount.factor), 0.0, 1.0);
    const double weight_b = share * reflectance_b;
    return grey_value(weight_b / (weight_b + (1 - share) * reflectance_a));
}

/// The model of a mixture.
BrdfModel mixed_model(const SurfaceFormula& a, const SurfaceFormula& b) {
    if (a.model == BrdfModel::lambert) return b.model;
    return b.model == BrdfModel::lambert || a.model == b.model ? a.model : BrdfModel::frostbite;
}

SurfaceFormula blended(TextureFormulas& formulas, const SurfaceFormula& a, const SurfaceFormula& b,
                       const TextureValue& amount) {
    SurfaceFormula result;
    result.model = mixed_model(a, b);
    result.diffuse = formulas.mix(a.diffuse, b.diffuse, amount);
    result.f0 = formulas.mix(a.f0, b.f0, amount);
    const TextureValue share = roughness_share(a, b, amount);
    result.roughness = formulas.mix(a.roughness, b.roughness, share);
    // Exponents cannot be images: an image of the share counts as a half.
    const double share_of_b = share.node < 0 ? mean(share.factor) : 0.5;
    result.exponent = (1 - share_of_b) * a.exponent + share_of_b * b.exponent;
    // Integrals along lines are not exact between.
    if (result.exponent > 0 && result.exponent < 1) result.exponent = 1;
    result.alpha = formulas.mix(a.alpha, b.alpha, amount);
    result.bump = formulas.mix(a.bump, b.bump, amount);
    result.bump_unit = a.bump.node >= 0 ? a.bump_unit : b.bump_unit;
    result.normal = a.normal.node >= 0 ? a.normal : b.normal;
    return result;
}

class Reduction {
public:
    Reduction(TextureTable& textures, const FindMaterial& find_material, Warnings& warnings)
        : textures_(textures), find_material_(find_material), warnings_(warnings) {}

    std::optional<SurfaceFormula> surface(MaterialDirective& directive, int mixture_depth) {
        MaterialReader m(directive, textures_, warnings_);
        if (directive.type == "mix") return mixture(m, mixture_depth);
        MaterialReduction reduce = find_reduction_v3(directive.type);
        if (reduce == nullptr) reduce = find_reduction_v4(directive.type);
        if (reduce == nullptr) reduce = find_extension(directive.type);
        const bool is_known = reduce != nullptr;
        std::optional<SurfaceFormula> result = is_known ? reduce(m) : unknown(m);
        if (!result) return std::nullopt;
        read_relief(m, directive, *result);
        m.parameters().ignore({"type"});
        if (is_known) m.parameters().warn_unused("material \"" + directive.type + '"', warnings_);
        return result;
    }

private:
    static SurfaceFormula unknown(MaterialReader& m) {
        m.warn("not supported; a Lambertian surface replaces it");
        SurfaceFormula surface;
        surface.diffuse = grey_value(0.5);
        for (const std::string_view name : {"color", "reflectance", "Kd"})
            if (m.has_colour(name)) surface.diffuse = m.unit_colour(name, 0.5);
        return surface;
    }

    /// Bump and normal maps.
    void read_relief(MaterialReader& m, const MaterialDirective& directive, SurfaceFormula& surface) {
        // pbrt v3 has bumpmap, v4 has displacement.
        if (m.parameters().texture("bumpmap")) {
            surface.bump = m.number("bumpmap", 0);
            surface.bump_unit = BumpUnit::texture_coordinate;
        }
        if (m.parameters().texture("displacement")) {
            surface.bump = m.number("displacement", 0);
            surface.bump_unit = BumpUnit::metre;
        }
        if (m.parameters().string("normalmap", "").empty()) return;
        surface.normal =
            textures_.linear_image(directive.normal_map, m.parameters().location_of("normalmap"));
        if (surface.bump.node < 0) return;
        m.warn("displacement is ignored because of the normal map");
        surface.bump = grey_value(0);
    }

    std::optional<SurfaceFormula> part(MaterialReader& m, std::string_view parameter, const std::string& name,
                                       int depth) {
        MaterialDirective* const directive = name.empty() ? nullptr : find_material_(name);
        if (directive == nullptr) m.fail(parameter, "the material \"" + name + "\" to mix is not defined");
        if (depth == kMaxMixtureDepth)
            m.fail(parameter, "mixtures are nested more than " + std::to_string(kMaxMixtureDepth) +
                                  " deep; check whether it contains itself");
        return surface(*directive, depth + 1);
    }

    std::optional<SurfaceFormula> mixture(MaterialReader& m, int depth) {
        m.warn("the parameters of both materials are blended");
        TextureFormulas& formulas = textures_.formulas();
        std::optional<SurfaceFormula> first;
        std::optional<SurfaceFormula> second;
        // The share of the second one is v4's amount; v3's is that of the first.
        TextureValue share;
        if (const auto names = m.parameters().strings("materials"); !names.empty()) {
            if (names.size() != 2)
                m.fail("materials",
                       "\"materials\" must name two materials, found " + std::to_string(names.size()));
            share = m.unit_number("amount", 0.5);
            first = part(m, "materials", names[0], depth);
            second = part(m, "materials", names[1], depth);
        } else {
            share = formulas.inverted(m.unit_colour("amount", 0.5));
            first = part(m, "namedmaterial1", m.parameters().string("namedmaterial1", ""), depth);
            second = part(m, "namedmaterial2", m.parameters().string("namedmaterial2", ""), depth);
        }
        m.parameters().ignore({"type"});
        m.parameters().warn_unused("material \"mix\"", warnings_);
        if (!first && !second) return std::nullopt;
        if (first && second) return blended(formulas, *first, *second, share);
        // If one material is invisible, the other one covers only its share.
        SurfaceFormula result = first ? *first : *second;
        result.alpha = formulas.product(result.alpha, first ? formulas.inverted(share) : share);
        return result;
    }

    TextureTable& textures_;
    const FindMaterial& find_material_;
    Warnings& warnings_;
};

} // namespace

std::optional<Material> reduce_material(MaterialDirective& directive, TextureTable& textures,
                                        const FindMaterial& find_material, Warnings& warnings) {
    const auto surface = Reduction(textures, find_material, warnings).surface(directive, 0);
    if (!surface) return std::nullopt;
    Material material = make_material(*surface, textures.planner(), directive.parameters.location());
    material.name = directive.name;
    return material;
}

} // namespace nusselt::scene
