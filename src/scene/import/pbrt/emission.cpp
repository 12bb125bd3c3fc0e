#include "scene/import/pbrt/emission.h"

#include "scene/model/vector_math.h"

#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

bool is_radiance(float value) { return value >= 0 && value <= std::numeric_limits<float>::max(); }

Float3 mean_texel(const Texture& texture) {
    Double3 sum;
    const auto channels = static_cast<std::size_t>(texture.channels);
    const std::size_t green = channels > 1 ? 1 : 0;
    for (std::size_t i = 0; i + channels <= texture.texels.size(); i += channels)
        sum = sum + Double3{texture.texels[i], texture.texels[i + green], texture.texels[i + 2 * green]};
    return to_float((static_cast<double>(channels) / static_cast<double>(texture.texels.size())) * sum);
}

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

void check_radiance(const Float3& radiance, const Location& location) {
    for (const float value : {radiance.x, radiance.y, radiance.z})
        if (!is_radiance(value))
            throw SceneError(location, "AreaLightSource: radiance must be finite and not negative, found " +
                                           to_text(value));
}

} // namespace

Float3 EmissionImages::mean_colour(const ImageRequest& request, SceneBudget& budget, Warnings& warnings) {
    const auto known = mean_colours_.find(request.path);
    if (known != mean_colours_.end()) return known->second;
    const Float3 mean = mean_texel(decode_image(request, budget, warnings));
    mean_colours_.emplace(request.path, mean);
    return mean;
}

Emission read_emission(const std::string& type, ParameterList& parameters,
                       const std::filesystem::path& image_path, EmissionImages& images, Warnings& warnings) {
    // "area" is pbrt v2's name for it.
    if (type != "diffuse" && type != "area") {
        warnings.add(parameters.location(),
                     "AreaLightSource \"" + type + "\" is not supported: its shapes do not emit");
        return {};
    }
    Emission emission;
    emission.power = read_power(parameters);
    Float3 colour = parameters.colour("L", {1, 1, 1}, warnings, SpectrumUse::illuminant);
    if (!parameters.string("filename", "").empty()) {
        ImageRequest request;
        request.path = image_path;
        request.location = parameters.location_of("filename");
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
    check_radiance(emission.radiance, parameters.location());
    parameters.ignore({"samples", "nsamples", "xsamples", "ysamples"});
    parameters.warn_unused("AreaLightSource", warnings);
    return emission;
}

Float3 radiance_of(const Emission& emission, double area, const Location& location) {
    if (!emission.power) return emission.radiance;
    const double sides = emission.two_sided ? 2 : 1;
    const Float3 radiance =
        to_float((*emission.power / (sides * std::numbers::pi * area)) * to_double(emission.radiance));
    check_radiance(radiance, location);
    return radiance;
}

} // namespace nusselt::scene
