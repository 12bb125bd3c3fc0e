#include "scene/import/pbrt/directives/emission_directive.h"

#include "scene/model/vector_math.h"

namespace nusselt::scene {

namespace {

std::optional<double> read_power(ParameterList& parameters) {
    const std::optional<double> power = parameters.optional_real("power");
    // In pbrt negative values, -1 by default, stand for none.
    return power && *power > 0 ? power : std::nullopt;
}

} // namespace

Emission read_emission(const std::string& type, ParameterList& parameters,
                       const std::filesystem::path& image_path, EmissionImages& images, Warnings& warnings) {
    // "area" is pbrt v2's name for it.
    if (type != "diffuse" && type != "area") {
        warnings.add(parameters.location(),
                     "AreaLightSource \"" + type + "\" is not supported; its shapes do not emit light");
        return {};
    }
    Emission emission;
    emission.power = read_power(parameters);
    Float3 colour = parameters.colour("L", {1, 1, 1}, warnings, SpectrumUse::illuminant);
    if (!parameters.string("filename", "").empty()) {
        ImageRequest request;
        request.path = image_path;
        request.location = parameters.location_of("filename");
        if (parameters.named_files().note(request.location, "texture file", request.path))
            emission.texture = images.read(request, parameters.budget(), warnings);
        colour = {1, 1, 1};
    }
    // v3 also scales by a colour.
    const auto scale = static_cast<float>(parameters.real("scale", 1));
    const Float3 tint = parameters.colour("scale", {scale, scale, scale}, warnings);
    emission.radiance = {colour.x * tint.x, colour.y * tint.y, colour.z * tint.z};
    emission.two_sided = parameters.boolean("twosided", false);
    check_radiance(emission.radiance, "AreaLightSource", parameters.location());
    parameters.ignore({"samples", "nsamples", "xsamples", "ysamples"});
    parameters.warn_unused("AreaLightSource", warnings);
    return emission;
}

} // namespace nusselt::scene
