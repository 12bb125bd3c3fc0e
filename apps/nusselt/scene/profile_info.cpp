#include "profile_info.h"

#include "scene/import/ies/ies_profile.h"
#include "scene/model/profiles/profile_radiance.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <string_view>

namespace nusselt::app {

namespace {

using scene::IesFile;
using scene::IntensityProfile;

constexpr double kDegrees = 180 / std::numbers::pi;

std::string_view name_of(scene::PhotometricType type) {
    switch (type) {
    case scene::PhotometricType::a:
        return "A";
    case scene::PhotometricType::b:
        return "B";
    case scene::PhotometricType::c:
        break;
    }
    return "C";
}

std::string_view describe(scene::ProfileSymmetry symmetry) {
    switch (symmetry) {
    case scene::ProfileSymmetry::none:
        return "without symmetry";
    case scene::ProfileSymmetry::rotational:
        return "rotationally symmetric";
    case scene::ProfileSymmetry::plane_0:
        return "mirrored in the plane of 0 and 180 degrees";
    case scene::ProfileSymmetry::plane_90:
        return "mirrored in the plane of 90 and 270 degrees";
    case scene::ProfileSymmetry::quadrants:
        break;
    }
    return "mirrored in the planes of 0 and 90 degrees";
}

void print_file(const IesFile& file) {
    fmt::print("format       IES profile, LM-63 of {}\n", file.version);
    for (const auto& [keyword, text] : file.keywords)
        if ((keyword == "MANUFAC" || keyword == "LUMCAT" || keyword == "LUMINAIRE") && !text.empty())
            fmt::print("{:12} {}\n", keyword, scene::message_line(text));
    fmt::print("photometry   type {}, {}\n", name_of(file.type), describe(file.symmetry));
    fmt::print("angles       {} vertical ({:.6g} to {:.6g}), {} horizontal ({:.6g} to {:.6g}) degrees\n",
               file.vertical.size(), file.vertical.front(), file.vertical.back(), file.horizontal.size(),
               file.horizontal.front(), file.horizontal.back());
    fmt::print("factors      {:.6g} in all\n", file.multiplier);
    if (file.generation) fmt::print("generation   {:.6g}\n", *file.generation);
    if (file.lumens_per_lamp < 0) {
        fmt::print("lamps        {}, absolute photometry\n", file.lamps);
    } else {
        fmt::print("lamps        {} of {:.6g} lm\n", file.lamps, file.lumens_per_lamp);
    }
    if (!file.tilt) return;
    const auto [least, most] = std::minmax_element(file.tilt->factors.begin(), file.tilt->factors.end());
    fmt::print("tilt         {} factors from {:.6g} to {:.6g}, which are not applied\n",
               file.tilt->factors.size(), *least, *most);
}

void print_distribution(const IntensityProfile& profile) {
    const double flux = profile.flux();
    const auto percent = [&](double part) { return flux > 0 ? 100 * part / flux : 0; };
    fmt::print("flux         {:.6g} lm, {:.4g} % down and {:.4g} % up\n", flux, percent(profile.lower_flux()),
               percent(profile.upper_flux()));
    const IntensityProfile::Peak peak = profile.peak();
    fmt::print("intensity    up to {:.6g} cd, at vertical {:.6g}, horizontal {:.6g} degrees\n", peak.candelas,
               peak.vertical * kDegrees, peak.horizontal * kDegrees);
    const auto print_spread = [&](const char* name, double share) {
        const double across_0 = profile.spread(0, share);
        const double across_90 = profile.spread(std::numbers::pi / 2, share);
        fmt::print("{} {:.4g} degrees in the plane of 0, {:.4g} in that of 90\n", name, across_0 * kDegrees,
                   across_90 * kDegrees);
    };
    print_spread("beam angle  ", 0.5);
    print_spread("field angle ", 0.1);
}

void print_light(const scene::LuminousOpening& opening, const IntensityProfile& profile) {
    fmt::print("opening      {}", scene::name_of(opening.shape));
    if (opening.shape != scene::OpeningShape::point)
        fmt::print(", length {:.4g}, width {:.4g}, height {:.4g} m", opening.length, opening.width,
                   opening.height);
    fmt::print("\nflat light   loses {:.3g} % of the flux", 100 * scene::share_lost_by_flat_light(profile));
    const double area = opening.area_from_below();
    if (area > 0)
        fmt::print("; {:.4g} m^2, straight down {:.4g} W/(sr m^2)", area,
                   scene::flat_radiance(profile, area, {0, 0, 1}));
    fmt::print("\n");
}

} // namespace

int run_profile_info(const std::filesystem::path& path) {
    const IesFile file = scene::read_ies(path);
    const IntensityProfile profile = scene::make_profile(file);
    print_file(file);
    print_distribution(profile);
    print_light(file.opening, profile);
    return 0;
}

} // namespace nusselt::app
