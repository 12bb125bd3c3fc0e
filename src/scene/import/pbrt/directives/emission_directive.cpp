#include "scene/import/pbrt/directives/emission_directive.h"

#include "scene/model/vector_math.h"

namespace nusselt::scene {

namespace {

/// Black stays black.
Float3 with_unit_luminance(const Float3& colour) {
    const double brightness = luminance(to_double(colour));
    return brightness > 0 ? to_float((1 / brightness) * to_double(colour)) : colour;
}

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
            colour = images.mean_colour(request, parameters.budget(), warnings);
        warnings.add(request.location,
                     "AreaLightSource: the image of the emission is replaced by its mean colour");
        // The power is that of the image, whatever its brightness.
        if (emission.power) colour = with_unit_luminance(colour);
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
