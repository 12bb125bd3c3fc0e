#include "scene/materials.h"

#include "scene/vector_math.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace nusselt::scene {

namespace {

Float3 grey(double value) {
    const auto v = static_cast<float>(value);
    return {v, v, v};
}
Float3 product(const Float3& a, const Float3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
bool is_zero(const Float3& c) { return c.x == 0 && c.y == 0 && c.z == 0; }

/// Optical constants at the wavelengths of red, green and blue.
struct NamedMetal {
    std::string_view eta_name, k_name;
    Float3 eta, k;
};
constexpr NamedMetal kMetals[] = {
    {"metal-Cu-eta", "metal-Cu-k", {0.200438f, 0.924033f, 1.102212f}, {3.912949f, 2.452848f, 2.142188f}},
    {"metal-Ag-eta", "metal-Ag-k", {0.155265f, 0.116723f, 0.138342f}, {4.828370f, 3.122500f, 2.147040f}},
    {"metal-Al-eta", "metal-Al-k", {1.657460f, 0.880369f, 0.521229f}, {9.223869f, 6.269523f, 4.837001f}},
    {"metal-Au-eta", "metal-Au-k", {0.143119f, 0.374957f, 1.442479f}, {3.983160f, 2.385721f, 1.603215f}},
};
constexpr const NamedMetal& kCopper = kMetals[0];

/// The alpha of surfaces that are perfectly smooth in pbrt.
constexpr double kPolishedAlpha = 0.01;

class Reduction {
public:
    Reduction(MaterialDirective& directive, const TextureTable& textures, Warnings& warnings)
        : parameters_(directive.parameters), type_(directive.type), textures_(textures), warnings_(warnings) {
        material_.name = directive.name;
        material_.f0 = {0, 0, 0};
    }

    std::optional<Material> run();

private:
    using Step = bool (Reduction::*)();

    /// \return whether the surface is visible, like all steps
    bool matte();
    bool diffuse();
    bool substrate();
    bool plastic();
    bool uber();
    bool coated_diffuse();
    bool metal();
    bool conductor();
    bool coated_conductor();
    bool mirror();
    bool glass();
    bool dielectric();
    bool disney();
    bool invisible() { return false; }
    bool unknown();

    TextureValue value(std::string_view name, const Float3& fallback) {
        if (const auto texture = parameters_.texture(name))
            return textures_.value(*texture, parameters_.location_of(name));
        return {parameters_.colour(name, fallback, warnings_), -1};
    }
    /// A parameter for which images are not supported.
    Float3 colour(std::string_view name, const Float3& fallback) {
        const TextureValue result = value(name, fallback);
        if (result.image < 0) return result.factor;
        warn_image(name);
        return fallback;
    }
    double real(std::string_view name, double fallback) {
        if (const auto texture = parameters_.texture(name)) {
            const TextureValue result = textures_.value(*texture, parameters_.location_of(name));
            if (result.image < 0) return result.factor.x;
            warn_image(name);
            return fallback;
        }
        return parameters_.real(name, fallback);
    }
    void warn(std::string_view message) {
        warnings_.add(parameters_.location(), "material " + type_ + ' ' + std::string(message),
                      "material \"" + type_ + "\": " + std::string(message));
    }
    void warn_image(std::string_view name) {
        warnings_.add(parameters_.location_of(name), "material image " + std::string(name),
                      "material \"" + material_.name + "\": an image for \"" + std::string(name) +
                          "\" is not supported, its default is used");
    }
    void set_albedo(std::string_view name, double fallback, const Float3& factor) {
        const TextureValue albedo = value(name, grey(fallback));
        material_.diffuse = product(albedo.factor, factor);
        material_.diffuse_texture.texture = albedo.image;
    }
    void set_black() { material_.diffuse = {0, 0, 0}; }
    /// \param prefix of the names of the parameters: "" or "conductor."
    void set_roughness(double fallback, double (*alpha_from_roughness)(double),
                       const std::string& prefix = "");
    /// Reflectances must not be negative; above 1 they would create energy and are clamped.
    void check_reflectance(Float3& reflectance, std::string_view what);
    void set_conductor(const char* eta_name, const char* k_name);
    Float3 metal_constant(const char* name, Float3 NamedMetal::*constant,
                          std::string_view NamedMetal::*spectrum);
    void set_lambert_if_without_reflection() {
        if (is_zero(material_.f0)) material_.model = BrdfModel::lambert;
    }

    ParameterList& parameters_;
    const std::string& type_;
    const TextureTable& textures_;
    Warnings& warnings_;
    Material material_;
};

void Reduction::check_reflectance(Float3& reflectance, std::string_view what) {
    bool is_clamped = false;
    for (float* channel : {&reflectance.x, &reflectance.y, &reflectance.z}) {
        if (!(*channel >= 0))
            throw SceneError(parameters_.location(), "material \"" + material_.name +
                                                         "\": " + std::string(what) +
                                                         " must not be negative, found " + to_text(*channel));
        is_clamped = is_clamped || *channel > 1;
        *channel = std::min(*channel, 1.0f);
    }
    if (is_clamped) warn(std::string(what) + " above 1 is clamped to 1");
}

void Reduction::set_roughness(double fallback, double (*alpha_from_roughness)(double),
                              const std::string& prefix) {
    const double both = real(prefix + "roughness", fallback);
    const double u = real(prefix + "uroughness", both);
    const double v = real(prefix + "vroughness", both);
    for (const double r : {u, v})
        if (!(r >= 0))
            throw SceneError(parameters_.location_of(prefix + "roughness"),
                             "material \"" + material_.name + "\": roughness must not be negative, found " +
                                 to_text(r));
    const bool remap = parameters_.boolean("remaproughness", true);
    const auto alpha = [&](double r) { return remap ? alpha_from_roughness(r) : r; };
    if (u != v) warn("anisotropic roughness is replaced by its geometric mean");
    const bool is_smooth = u == 0 && v == 0;
    material_.roughness = roughness_from_alpha(is_smooth ? kPolishedAlpha : std::sqrt(alpha(u) * alpha(v)));
}

Float3 Reduction::metal_constant(const char* name, Float3 NamedMetal::*constant,
                                 std::string_view NamedMetal::*spectrum) {
    if (const auto spectrum_name = parameters_.spectrum_name(name))
        for (const NamedMetal& metal : kMetals)
            if (metal.*spectrum == *spectrum_name) return metal.*constant;
    return colour(name, kCopper.*constant);
}

void Reduction::set_conductor(const char* eta_name, const char* k_name) {
    const Float3 eta = metal_constant(eta_name, &NamedMetal::eta, &NamedMetal::eta_name);
    const Float3 k = metal_constant(k_name, &NamedMetal::k, &NamedMetal::k_name);
    material_.model = BrdfModel::frostbite;
    material_.f0 = to_float({conductor_f0(eta.x, k.x), conductor_f0(eta.y, k.y), conductor_f0(eta.z, k.z)});
    set_black();
}

bool Reduction::matte() {
    set_albedo("Kd", 0.5, grey(1));
    if (real("sigma", 0) > 0) warn("sigma is ignored, the surface is Lambertian");
    return true;
}

bool Reduction::diffuse() {
    set_albedo("reflectance", 0.5, grey(1));
    if (real("sigma", 0) > 0) warn("sigma is ignored, the surface is Lambertian");
    return true;
}

bool Reduction::substrate() {
    material_.model = BrdfModel::frostbite;
    material_.f0 = colour("Ks", grey(0.5));
    check_reflectance(material_.f0, "Ks");
    const Float3& f0 = material_.f0;
    set_albedo("Kd", 0.5, {1 - f0.x, 1 - f0.y, 1 - f0.z});
    set_roughness(0.1, alpha_from_roughness_v3);
    return true;
}

bool Reduction::plastic() {
    material_.model = BrdfModel::frostbite;
    material_.f0 = product(colour("Ks", grey(0.25)), grey(dielectric_f0(1.5)));
    set_albedo("Kd", 0.25, grey(1));
    set_roughness(0.1, alpha_from_roughness_v3);
    set_lambert_if_without_reflection();
    return true;
}

bool Reduction::uber() {
    const TextureValue opacity = value("opacity", grey(1));
    if (opacity.image < 0 && is_zero(opacity.factor)) {
        warn("opacity 0 makes surfaces invisible, they are left out");
        return false;
    }
    if (opacity.image >= 0 || opacity.factor.x < 1 || opacity.factor.y < 1 || opacity.factor.z < 1)
        warn("opacity between 0 and 1 is treated as 1");
    material_.model = BrdfModel::frostbite;
    const double eta = real("eta", real("index", 1.5));
    material_.f0 = product(colour("Ks", grey(0.25)), grey(dielectric_f0(eta)));
    set_albedo("Kd", 0.25, grey(1));
    set_roughness(0.1, alpha_from_roughness_v3);
    if (!is_zero(colour("Kr", grey(0))) || !is_zero(colour("Kt", grey(0))))
        warn("mirror reflection and transmission (Kr, Kt) are ignored");
    set_lambert_if_without_reflection();
    return true;
}

bool Reduction::coated_diffuse() {
    material_.model = BrdfModel::frostbite;
    material_.f0 = grey(dielectric_f0(real("eta", 1.5)));
    set_albedo("reflectance", 0.5, grey(1));
    set_roughness(0, alpha_from_roughness_v4);
    parameters_.ignore({"thickness", "maxdepth", "nsamples", "g"});
    return true;
}

bool Reduction::metal() {
    set_conductor("eta", "k");
    set_roughness(0.01, alpha_from_roughness_v3);
    return true;
}

bool Reduction::conductor() {
    if (parameters_.texture("reflectance") || parameters_.optional_colour("reflectance", warnings_)) {
        material_.model = BrdfModel::frostbite;
        material_.f0 = colour("reflectance", grey(1));
        set_black();
    } else {
        set_conductor("eta", "k");
    }
    set_roughness(0, alpha_from_roughness_v4);
    return true;
}

bool Reduction::coated_conductor() {
    warn("its coating is ignored");
    set_conductor("conductor.eta", "conductor.k");
    set_roughness(0, alpha_from_roughness_v4, "conductor.");
    return true;
}

bool Reduction::mirror() {
    warn("mirrors show only the lights, as a polished metal");
    material_.model = BrdfModel::frostbite;
    material_.f0 = colour("Kr", grey(0.9));
    set_black();
    material_.roughness = roughness_from_alpha(kPolishedAlpha);
    return true;
}

bool Reduction::glass() {
    warn("transmission is ignored, the surface is opaque and reflects only");
    const double eta = real("eta", real("index", 1.5));
    material_.model = BrdfModel::frostbite;
    material_.f0 = product(colour("Kr", grey(1)), grey(dielectric_f0(eta)));
    set_black();
    set_roughness(0, alpha_from_roughness_v3);
    parameters_.ignore({"Kt"});
    return true;
}

bool Reduction::dielectric() {
    warn("transmission is ignored, the surface is opaque and reflects only");
    material_.model = BrdfModel::frostbite;
    material_.f0 = grey(dielectric_f0(real("eta", 1.5)));
    set_black();
    set_roughness(0, alpha_from_roughness_v4);
    return true;
}

bool Reduction::disney() {
    warn("reduced to its base colour, metallic, eta and roughness");
    material_.model = BrdfModel::frostbite;
    const double metallic = std::clamp(real("metallic", 0), 0.0, 1.0);
    const TextureValue base = value("color", grey(0.5));
    const double plain = (1 - metallic) * dielectric_f0(real("eta", 1.5));
    const auto f0 = [&](float tint) {
        return static_cast<float>(plain + metallic * static_cast<double>(tint));
    };
    material_.f0 = {f0(base.factor.x), f0(base.factor.y), f0(base.factor.z)};
    material_.diffuse = product(base.factor, grey(1 - metallic));
    material_.diffuse_texture.texture = base.image;
    material_.roughness = roughness_from_alpha(std::pow(real("roughness", 0.5), 2));
    return true;
}

bool Reduction::unknown() {
    warn("not supported, replaced by a Lambertian surface");
    const bool is_v3 = parameters_.texture("Kd") || parameters_.optional_colour("Kd", warnings_);
    set_albedo(is_v3 ? "Kd" : "reflectance", 0.5, grey(1));
    return true;
}

std::optional<Material> Reduction::run() {
    static constexpr std::pair<std::string_view, Step> kSteps[] = {
        {"matte", &Reduction::matte},
        {"diffuse", &Reduction::diffuse},
        {"substrate", &Reduction::substrate},
        {"plastic", &Reduction::plastic},
        {"uber", &Reduction::uber},
        {"coateddiffuse", &Reduction::coated_diffuse},
        {"metal", &Reduction::metal},
        {"conductor", &Reduction::conductor},
        {"coatedconductor", &Reduction::coated_conductor},
        {"mirror", &Reduction::mirror},
        {"glass", &Reduction::glass},
        {"dielectric", &Reduction::dielectric},
        {"thindielectric", &Reduction::dielectric},
        {"disney", &Reduction::disney},
        {"interface", &Reduction::invisible},
        {"none", &Reduction::invisible},
        {"", &Reduction::invisible},
    };
    const auto* const found = std::find_if(std::begin(kSteps), std::end(kSteps),
                                           [&](const auto& step) { return step.first == type_; });
    const bool is_known = found != std::end(kSteps);
    if (!(this->*(is_known ? found->second : &Reduction::unknown))()) return std::nullopt;

    for (const std::string_view name : {"bumpmap", "displacement", "normalmap"}) {
        if (parameters_.texture(name) || !parameters_.string(name, "").empty())
            warnings_.add(parameters_.location_of(name), "bump", "bump and normal maps are ignored");
    }
    // The factor of an image may exceed 1: the image is darker.
    if (material_.diffuse_texture.texture < 0) check_reflectance(material_.diffuse, "diffuse reflectance");
    check_reflectance(material_.f0, "specular reflectance");
    parameters_.ignore({"type"});
    if (is_known) parameters_.warn_unused("material \"" + type_ + '"', warnings_);
    return material_;
}

} // namespace

std::optional<Material> reduce_material(MaterialDirective& directive, const TextureTable& textures,
                                        Warnings& warnings) {
    return Reduction(directive, textures, warnings).run();
}

double alpha_from_roughness_v3(double roughness) {
    const double x = std::log(std::max(roughness, 1e-3));
    return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

double alpha_from_roughness_v4(double roughness) { return std::sqrt(roughness); }

float roughness_from_alpha(double alpha) {
    constexpr double kMinAlpha = 1e-3;
    return static_cast<float>(std::sqrt(std::clamp(alpha, kMinAlpha, 1.0)));
}

double conductor_f0(double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

double dielectric_f0(double eta) { return conductor_f0(eta, 0); }

} // namespace nusselt::scene
