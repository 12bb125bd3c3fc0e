// The materials of pbrt v3.

#include "scene/import/pbrt/material_reader.h"
#include "scene/import/pbrt/syntax/name_table.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <utility>

namespace nusselt::scene {

namespace {

using Surface = std::optional<SurfaceFormula>;

bool is_zero(const TextureValue& value) {
    return value.factor.x == 0 && value.factor.y == 0 && value.factor.z == 0;
}

/// A dielectric layer above a diffuse base. Without reflection there is nothing for Schlick's formula to raise at
/// grazing angles.
SurfaceFormula layered(const TextureValue& diffuse, const TextureValue& f0, const TextureValue& roughness) {
    SurfaceFormula surface;
    surface.model = is_zero(f0) ? BrdfModel::lambert : BrdfModel::frostbite;
    surface.diffuse = diffuse;
    surface.f0 = f0;
    surface.roughness = roughness;
    return surface;
}

/// v2 and early v3 call it "index".
double refractive_index(MaterialReader& m, double fallback) {
    return m.refractive_index("eta", m.refractive_index("index", fallback));
}

Surface matte(MaterialReader& m) {
    SurfaceFormula surface;
    surface.diffuse = m.unit_colour("Kd", 0.5);
    m.warn_ignored({"sigma"});
    return surface;
}

Surface substrate(MaterialReader& m) {
    SurfaceFormula surface;
    surface.model = BrdfModel::frostbite;
    surface.f0 = m.unit_colour("Ks", 0.5);
    surface.diffuse = m.formulas().mix(m.unit_colour("Kd", 0.5), grey_value(0), surface.f0);
    surface.roughness = m.roughness(0.1, RoughnessRule::v3);
    return surface;
}

Surface plastic(MaterialReader& m) {
    const TextureValue f0 = m.formulas().product(m.unit_colour("Ks", 0.25), grey_value(dielectric_f0(1.5)));
    const TextureValue diffuse = m.unit_colour("Kd", 0.25);
    return layered(diffuse, f0, m.roughness(0.1, RoughnessRule::v3));
}

Surface uber(MaterialReader& m) {
    const TextureValue opacity = m.unit_colour("opacity", 1);
    if (is_zero(opacity)) {
        m.warn("surfaces with opacity 0 are invisible and skipped");
        return std::nullopt;
    }
    const double eta = refractive_index(m, 1.5);
    const TextureValue f0 = m.formulas().product(m.unit_colour("Ks", 0.25), grey_value(dielectric_f0(eta)));
    const TextureValue diffuse = m.unit_colour("Kd", 0.25);
    SurfaceFormula surface = layered(diffuse, f0, m.roughness(0.1, RoughnessRule::v3));
    surface.alpha = opacity;
    if (!is_zero(m.unit_colour("Kr", 0)) || !is_zero(m.unit_colour("Kt", 0)))
        m.warn("mirror reflection and transmission (Kr, Kt) are ignored");
    return surface;
}

Surface metal(MaterialReader& m) {
    const TextureValue f0 = m.conductor("", 1);
    return metallic(f0, m.roughness(0.01, RoughnessRule::v3));
}

Surface mirror(MaterialReader& m) {
    m.warn("mirrors are polished metals, which reflect only the lights");
    return metallic(m.unit_colour("Kr", 0.9), m.formulas().roughness(grey_value(0), RoughnessRule::alpha));
}

Surface glass(MaterialReader& m) {
    m.warn("transmission is ignored; the surface is opaque and only reflects");
    const double eta = refractive_index(m, 1.5);
    m.parameters().ignore({"Kt"});
    const TextureValue f0 = m.formulas().product(m.unit_colour("Kr", 1), grey_value(dielectric_f0(eta)));
    return metallic(f0, m.roughness(0, RoughnessRule::v3));
}

Surface translucent(MaterialReader& m) {
    m.warn("transmission is ignored; the surface only reflects");
    const TextureValue reflect = m.unit_colour("reflect", 0.5);
    m.parameters().ignore({"transmit"});
    const TextureValue f0 = m.formulas().product(m.unit_colour("Ks", 0.25), grey_value(dielectric_f0(1.5)));
    const TextureValue diffuse = m.formulas().product(m.unit_colour("Kd", 0.25), reflect);
    return layered(diffuse, m.formulas().product(f0, reflect), m.roughness(0.1, RoughnessRule::v3));
}

Surface disney(MaterialReader& m) {
    constexpr Double3 kLuminance = {0.212671, 0.715160, 0.072169}; // of pbrt v3, which rounds them so

    TextureFormulas& formulas = m.formulas();
    const TextureValue base = m.unit_colour("color", 0.5);
    const TextureValue metallic = m.unit_number("metallic", 0);
    const double plain = dielectric_f0(m.refractive_index("eta", 1.5));
    TextureValue dielectric = grey_value(plain);
    if (const double tint = std::clamp(m.constant("speculartint", 0), 0.0, 1.0); tint > 0) {
        const Float3& c = base.factor;
        const double luminance = dot(kLuminance, to_double(c));
        const auto tinted = [&](float channel) {
            const double hue = luminance > 0 ? static_cast<double>(channel) / luminance : 1;
            return static_cast<float>(std::min(1.0, plain * (1 + tint * (hue - 1))));
        };
        if (base.node < 0)
            dielectric = {{tinted(c.x), tinted(c.y), tinted(c.z)}, -1};
        else
            m.warn("speculartint is ignored where the colour is an image");
    }
    m.warn_ignored({"anisotropic", "sheen", "clearcoat", "spectrans", "flatness", "difftrans"});
    m.parameters().ignore({"sheentint", "clearcoatgloss", "scatterdistance", "thin"});
    SurfaceFormula surface;
    surface.model = BrdfModel::frostbite;
    surface.diffuse = formulas.mix(base, grey_value(0), metallic);
    surface.f0 = formulas.mix(dielectric, base, metallic);
    surface.roughness = formulas.roughness(m.number("roughness", 0.5), RoughnessRule::disney);
    return surface;
}

/// The diffuse albedo of a medium from its coefficients.
TextureValue albedo_of_medium(MaterialReader& m) {
    // pbrt's defaults, in 1/mm.
    const Float3 absorption = m.constant_colour("sigma_a", {0.0011f, 0.0024f, 0.014f});
    const Float3 scattering =
        m.constant_colour("sigma_s", m.constant_colour("sigma_prime_s", {2.55f, 3.21f, 3.77f}));
    const double isotropy = 1 - std::clamp(m.constant("g", 0), -1.0, 1.0);
    const auto albedo = [isotropy](float a, float s) {
        return static_cast<float>(medium_albedo(std::max(0.0, static_cast<double>(a)),
                                                isotropy * std::max(0.0, static_cast<double>(s))));
    };
    return {{albedo(absorption.x, scattering.x), albedo(absorption.y, scattering.y),
             albedo(absorption.z, scattering.z)},
            -1};
}

Surface subsurface(MaterialReader& m) {
    m.warn("subsurface scattering is replaced by a diffuse surface under a clear coat");
    const double eta = m.refractive_index("eta", 1.33);
    const TextureValue f0 = m.formulas().product(m.unit_colour("Kr", 1), grey_value(dielectric_f0(eta)));
    const TextureValue diffuse =
        m.has_colour("reflectance") ? m.unit_colour("reflectance", 0.5) : albedo_of_medium(m);
    m.parameters().ignore({"Kt", "scale", "mfp"});
    return layered(diffuse, f0, m.roughness(0, RoughnessRule::v3));
}

Surface kdsubsurface(MaterialReader& m) {
    m.warn("subsurface scattering is replaced by a diffuse surface under a clear coat");
    const double eta = m.refractive_index("eta", 1.33);
    const TextureValue f0 = m.formulas().product(m.unit_colour("Kr", 1), grey_value(dielectric_f0(eta)));
    m.parameters().ignore({"Kt", "scale", "g", "mfp"});
    return layered(m.unit_colour("Kd", 0.5), f0, m.roughness(0, RoughnessRule::v3));
}

constexpr std::pair<std::string_view, MaterialReduction> kReductions[] = {
    {"matte", matte},
    {"substrate", substrate},
    {"plastic", plastic},
    {"uber", uber},
    {"metal", metal},
    {"mirror", mirror},
    {"glass", glass},
    {"translucent", translucent},
    {"disney", disney},
    {"subsurface", subsurface},
    {"kdsubsurface", kdsubsurface},
};

} // namespace

MaterialReduction find_reduction_v3(std::string_view type) { return find_named(kReductions, type); }

} // namespace nusselt::scene
