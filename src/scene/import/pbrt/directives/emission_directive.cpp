#include "scene/import/pbrt/directives/emission_directive.h"

#include "scene/colour/colour_space.h"
#include "scene/model/vector_math.h"

#include <cmath>

namespace nusselt::scene {

namespace {

std::optional<double> read_power(ParameterList& parameters) {
    const std::optional<double> power = parameters.optional_real("power");
    // In pbrt negative values, -1 by default, stand for none.
    return power && *power > 0 ? power : std::nullopt;
}

/// Reads the extensions "ies", "iesangle", "spread" and "honeycomb".
void read_profile(ParameterList& parameters, const std::filesystem::path& path, Luminaires& luminaires,
                  Emission& emission) {
    const auto fail = [&](std::string_view parameter, const std::string& message) {
        throw SceneError(parameters.location_of(parameter), "AreaLightSource: " + message);
    };
    const auto check_angle = [&](std::string_view parameter, double angle) {
        if (!(angle >= kNarrowestSpread && angle <= kWidestSpread))
            fail(parameter, std::string(parameter) + " must be from " + to_text(kNarrowestSpread) + " to " +
                                to_text(kWidestSpread) + " degrees, found " + to_text(angle));
    };
    ProfileRequest profile;
    profile.spread = parameters.real("spread", kWidestSpread);
    check_angle("spread", profile.spread);
    if (const std::vector<double> angles = parameters.reals("honeycomb"); !angles.empty()) {
        if (angles.size() > 2) fail("honeycomb", "honeycomb must have one or two angles");
        profile.honeycomb = {angles.front(), angles.back()};
        check_angle("honeycomb", profile.honeycomb.along);
        check_angle("honeycomb", profile.honeycomb.across);
        if (profile.spread < kWidestSpread)
            fail("honeycomb", "\"honeycomb\" and \"spread\" do not work together; keep one of them");
    }
    const bool has_ies = !parameters.string("ies", "").empty();
    if (has_ies || profile.honeycomb != HoneycombAngles{}) {
        profile.angle = parameters.real("iesangle", 0);
        if (!(std::fabs(profile.angle) <= 3600))
            fail("iesangle", "iesangle must be from -3600 to 3600 degrees");
    }
    if (has_ies) {
        const Location location = parameters.location_of("ies");
        if (parameters.named_files().note(location, "IES file", path))
            profile.luminaire = luminaires.read(path);
        // The lumens of the file are right for any colour.
        if (const double brightness = luminance(to_double(emission.radiance)); brightness > 0)
            emission.radiance =
                to_float((parameters.real("scale", 1) / brightness) * to_double(emission.radiance));
    }
    if (!has_effect(profile)) return;
    if (emission.texture != nullptr)
        fail("filename",
             "an image and \"ies\", \"spread\" or \"honeycomb\" do not work together; keep one of them");
    emission.profile = std::make_shared<const ProfileRequest>(std::move(profile));
}

} // namespace

Emission read_emission(const std::string& type, ParameterList& parameters, const EmissionPaths& paths,
                       EmissionFiles& files, Warnings& warnings) {
    // "area" is pbrt v2's name for it.
    if (type != "diffuse" && type != "area") {
        warnings.add(parameters.location(),
                     "AreaLightSource \"" + type + "\" is not supported; its shapes do not emit light");
        return {};
    }
    Emission emission;
    emission.power = read_power(parameters);
    const std::optional<Float3> given = parameters.optional_colour("L", warnings, SpectrumUse::illuminant);
    Float3 colour = given.value_or(Float3{1, 1, 1});
    if (!parameters.string("filename", "").empty()) {
        if (given)
            warnings.add(parameters.location_of("L"),
                         "AreaLightSource: L is ignored, because the image has the colours; use \"scale\"");
        ImageRequest request;
        request.path = paths.image;
        request.location = parameters.location_of("filename");
        if (parameters.named_files().note(request.location, "texture file", request.path))
            emission.texture = files.images.read(request, parameters.budget(), warnings);
        colour = {1, 1, 1};
    }
    // v3 also scales by a colour.
    const auto scale = static_cast<float>(parameters.real("scale", 1));
    const Float3 tint = parameters.colour("scale", {scale, scale, scale}, warnings);
    emission.radiance = {colour.x * tint.x, colour.y * tint.y, colour.z * tint.z};
    read_profile(parameters, paths.ies, files.luminaires, emission);
    emission.two_sided = parameters.boolean("twosided", false);
    check_radiance(emission.radiance, "AreaLightSource", parameters.location());
    parameters.ignore({"samples", "nsamples", "xsamples", "ysamples"});
    parameters.warn_unused("AreaLightSource", warnings);
    return emission;
}

} // namespace nusselt::scene
