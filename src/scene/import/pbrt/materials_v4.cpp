// The materials of pbrt v4.

#include "scene/import/pbrt/material_reader.h"
#include "scene/import/pbrt/syntax/name_table.h"

#include <utility>

namespace nusselt::scene {

namespace {

using Surface = std::optional<SurfaceFormula>;

Surface diffuse(MaterialReader& m) {
    SurfaceFormula surface;
    surface.diffuse = m.unit_colour("reflectance", 0.5);
    m.warn_ignored({"sigma"});
    return surface;
}

Surface coated_diffuse(MaterialReader& m) {
    SurfaceFormula surface;
    surface.model = BrdfModel::frostbite;
    surface.f0 = grey_value(dielectric_f0(m.refractive_index("eta", 1.5)));
    surface.diffuse = m.unit_colour("reflectance", 0.5);
    surface.roughness = m.roughness(0, RoughnessRule::v4);
    m.parameters().ignore({"thickness", "maxdepth", "nsamples", "g"});
    return surface;
}

Surface conductor(MaterialReader& m) {
    const TextureValue f0 =
        m.has_colour("reflectance") ? m.unit_colour("reflectance", 1) : m.conductor("", 1);
    return metallic(f0, m.roughness(0, RoughnessRule::v4));
}

/// The rougher one of two constants.
TextureValue rougher(MaterialReader& m, const TextureValue& base, const TextureValue& coat) {
    if (coat.node < 0 && base.node < 0) return coat.factor.x > base.factor.x ? coat : base;
    if (coat.node >= 0) m.warn("images for the roughness of the coating are ignored");
    return base;
}

Surface coated_conductor(MaterialReader& m) {
    m.warn("the coating and the metal are combined into one lobe");
    const double coat_eta = m.refractive_index("interface.eta", 1.5);
    TextureValue f0;
    if (m.has_colour("reflectance")) {
        // The coating transmits the rest, which is exact for a black and for a white metal.
        const TextureValue coat = grey_value(dielectric_f0(coat_eta));
        f0 = m.formulas().mix(coat, grey_value(1), m.unit_colour("reflectance", 1));
    } else {
        f0 = m.conductor("conductor.", coat_eta);
    }
    const TextureValue base = m.roughness(0, RoughnessRule::v4, "conductor.");
    const TextureValue roughness = rougher(m, base, m.roughness(0, RoughnessRule::v4, "interface."));
    m.parameters().ignore({"interface.thickness", "thickness", "maxdepth", "nsamples", "g"});
    return metallic(f0, roughness);
}

Surface dielectric(MaterialReader& m) {
    m.warn("transmission is ignored; the surface is opaque and only reflects");
    const double eta = m.refractive_index("eta", 1.5);
    return metallic(grey_value(dielectric_f0(eta)), m.roughness(0, RoughnessRule::v4));
}

Surface diffuse_transmission(MaterialReader& m) {
    m.warn("transmission is ignored; the surface only reflects");
    SurfaceFormula surface;
    surface.diffuse = m.formulas().product(m.unit_colour("reflectance", 0.25), m.unit_number("scale", 1));
    m.parameters().ignore({"transmittance"});
    return surface;
}

Surface invisible(MaterialReader&) { return std::nullopt; }

constexpr std::pair<std::string_view, MaterialReduction> kReductions[] = {
    {"diffuse", diffuse},
    {"coateddiffuse", coated_diffuse},
    {"conductor", conductor},
    {"coatedconductor", coated_conductor},
    {"dielectric", dielectric},
    {"thindielectric", dielectric},
    {"diffusetransmission", diffuse_transmission},
    {"interface", invisible},
    {"none", invisible},
    {"", invisible},
};

} // namespace

MaterialReduction find_reduction_v4(std::string_view type) { return find_named(kReductions, type); }

} // namespace nusselt::scene
