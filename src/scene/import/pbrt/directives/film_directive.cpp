#include "scene/import/pbrt/directives/film_directive.h"

#include "scene/model/limits.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace nusselt::scene {

namespace {

void check_resolution(std::string_view name, int value, const ParameterList& parameters) {
    if (value < 1 || value > kMaxFilmSize)
        throw SceneError(parameters.location_of(name),
                         "film: " + std::string(name) + " must lie between 1 and " +
                             std::to_string(kMaxFilmSize) + ", found " + std::to_string(value));
}

/// The pixels whose index times 1 / resolution lies in an interval of the unit interval, in any order of its ends.
std::pair<int, int> pixel_interval(double a, double b, int resolution) {
    const auto pixel = [&](double x) {
        return static_cast<int>(std::ceil(std::clamp(x, 0.0, 1.0) * resolution));
    };
    return {pixel(std::min(a, b)), pixel(std::max(a, b))};
}

/// Nothing if that is the whole film.
std::optional<PixelBounds> read_crop(const Film& film, ParameterList& parameters) {
    PixelBounds crop{0, 0, film.width, film.height};
    std::string_view name = "cropwindow";
    const std::vector<double> window = parameters.reals("cropwindow");
    const std::vector<double> pixels = parameters.integers("pixelbounds");
    if (!pixels.empty()) {
        name = "pixelbounds";
        if (pixels.size() != 4)
            throw SceneError(parameters.location_of(name),
                             "film: pixelbounds must be x begin, x end, y begin, y end; found " +
                                 std::to_string(pixels.size()) + " values");
        const auto pixel = [&](double x, int resolution) {
            return static_cast<int>(std::clamp<double>(x, 0, resolution));
        };
        crop = {pixel(pixels[0], film.width), pixel(pixels[2], film.height), pixel(pixels[1], film.width),
                pixel(pixels[3], film.height)};
    } else if (!window.empty()) {
        if (window.size() != 4)
            throw SceneError(parameters.location_of(name),
                             "film: cropwindow must be x begin, x end, y begin, y end; found " +
                                 std::to_string(window.size()) + " values");
        std::tie(crop.x_begin, crop.x_end) = pixel_interval(window[0], window[1], film.width);
        std::tie(crop.y_begin, crop.y_end) = pixel_interval(window[2], window[3], film.height);
    }
    if (crop.x_begin >= crop.x_end || crop.y_begin >= crop.y_end)
        throw SceneError(parameters.location_of(name),
                         "film: " + std::string(name) + " contains none of the " +
                             std::to_string(film.width) + " x " + std::to_string(film.height) + " pixels");
    if (crop.x_end - crop.x_begin == film.width && crop.y_end - crop.y_begin == film.height)
        return std::nullopt;
    return crop;
}

/// Parameters that would change the brightness of pixels.
void warn_of_sensor(ParameterList& parameters, Warnings& warnings) {
    std::string found;
    std::string_view first;
    const auto add = [&](std::string_view name, bool matters) {
        if (!matters) return;
        if (found.empty()) first = name;
        found += (found.empty() ? "" : ", ") + std::string(name);
    };
    add("scale", parameters.real("scale", 1) != 1);
    add("sensor", parameters.string("sensor", "cie1931") != "cie1931");
    add("iso", parameters.real("iso", 100) != 100);
    add("exposuretime", parameters.real("exposuretime", 1) != 1);
    add("imagingratio", parameters.real("imagingratio", 1) != 1);
    add("whitebalance", parameters.real("whitebalance", 0) != 0);
    add("maxcomponentvalue", parameters.optional_real("maxcomponentvalue").has_value());
    add("maxsampleluminance", parameters.optional_real("maxsampleluminance").has_value());
    if (!found.empty())
        warnings.add(parameters.location_of(first),
                     "film: ignored: " + found + "; images contain radiance in W/(sr m^2)");
}

/// Half the widths: v3 calls them width.
void read_radii(ParameterList& parameters, double fallback, PixelFilter& filter) {
    for (const auto& [names, radius] : {std::pair{std::pair{"xradius", "xwidth"}, &filter.radius_x},
                                        {std::pair{"yradius", "ywidth"}, &filter.radius_y}}) {
        const double value = parameters.real(names.first, parameters.real(names.second, fallback));
        constexpr double kMaxRadius = 64;
        if (!(value > 0 && value <= kMaxRadius))
            throw SceneError(parameters.location(),
                             "pixel filter: radii must be positive and at most 64 pixels, found " +
                                 to_text(value));
        *radius = static_cast<float>(value);
    }
}

void read_sigma(ParameterList& parameters, PixelFilter& filter) {
    // The filter of v3 is exp(-alpha x^2).
    const auto alpha = parameters.optional_real("alpha");
    const double sigma = parameters.real("sigma", alpha ? 1 / std::sqrt(2 * *alpha) : 0.5);
    // Beyond, the filter is a single point or a flat difference of nearly equal numbers.
    constexpr double kMaxRatio = 100;
    if (!(sigma * kMaxRatio >= std::max(filter.radius_x, filter.radius_y) &&
          sigma <= kMaxRatio * std::min(filter.radius_x, filter.radius_y)))
        throw SceneError(parameters.location_of(alpha ? "alpha" : "sigma"),
                         "pixel filter: sigma must lie between 0.01 and 100 times the radius, found " +
                             to_text(sigma));
    filter.sigma = static_cast<float>(sigma);
}

void read_mitchell(ParameterList& parameters, PixelFilter& filter) {
    for (const auto& [name, value] : {std::pair{"B", &filter.b}, {"C", &filter.c}}) {
        const double given = parameters.real(name, 1.0 / 3);
        if (!(given >= 0 && given <= 1))
            throw SceneError(parameters.location_of(name), "pixel filter: " + std::string(name) +
                                                               " must lie between 0 and 1, found " +
                                                               to_text(given));
        *value = static_cast<float>(given);
    }
}

} // namespace

Film read_film(std::string_view type, ParameterList& parameters, Warnings& warnings) {
    const bool is_v3 = type == "image";
    if (!is_v3 && type != "rgb")
        warnings.add(parameters.location(),
                     "film \"" + shortened(type) + "\" is not supported; \"rgb\" replaces it");
    Film film;
    film.width = parameters.integer("xresolution", is_v3 ? 640 : 1280);
    film.height = parameters.integer("yresolution", is_v3 ? 480 : 720);
    check_resolution("xresolution", film.width, parameters);
    check_resolution("yresolution", film.height, parameters);
    film.crop = read_crop(film, parameters);
    film.filename = parameters.string("filename", "");
    warn_of_sensor(parameters, warnings);
    parameters.ignore(
        {"diagonal", "savefp16", "coordinatesystem", "nbuckets", "lambdamin", "lambdamax", "buckets"});
    parameters.warn_unused("Film", warnings);
    return film;
}

PixelFilter read_pixel_filter(std::string_view type, ParameterList& parameters, PbrtVersion version,
                              Warnings& warnings) {
    PixelFilter filter;
    if (type == "box") {
        read_radii(parameters, 0.5, filter);
    } else if (type == "triangle") {
        filter.kind = FilterKind::triangle;
        read_radii(parameters, 2, filter);
    } else if (type == "gaussian") {
        filter.kind = FilterKind::gaussian;
        read_radii(parameters, version == PbrtVersion::v3 ? 2 : 1.5, filter);
        read_sigma(parameters, filter);
    } else if (type == "mitchell") {
        filter.kind = FilterKind::mitchell;
        read_radii(parameters, 2, filter);
        read_mitchell(parameters, filter);
    } else {
        filter.kind = FilterKind::mitchell;
        filter.radius_x = filter.radius_y = 2;
        warnings.add(parameters.location(),
                     "pixel filter \"" + shortened(type) +
                         "\" is not supported; \"mitchell\" with radius 2 replaces it");
        return filter;
    }
    parameters.warn_unused("PixelFilter", warnings);
    return filter;
}

} // namespace nusselt::scene
