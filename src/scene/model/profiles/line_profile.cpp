#include "scene/model/profiles/line_profile.h"

#include "scene/model/profiles/profile_radiance.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr double kPi = std::numbers::pi;

Double3 axis_of(const LineLight& light) { return to_double(light.end) - to_double(light.start); }

/// The frame of a light with a normal.
Axes axes_of(const LineLight& light) { return Axes::of(axis_of(light), to_double(light.normal)); }

Axes around(const Double3& z) {
    return Axes::of(std::fabs(z.x) < 0.9 ? Double3{1, 0, 0} : Double3{0, 1, 0}, z);
}

/// The integral of a function of directions over a band of angles from an axis [rad], by the midpoint rule with as
/// many rings as sectors.
template <class Function>
double band_integral(const Axes& axes, double begin, double end, int rings, const Function& f) {
    const int sectors = rings;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double angle = begin + (end - begin) * (i + 0.5) / rings;
        const double sine = std::sin(angle);
        const double cosine = std::cos(angle);
        for (int k = 0; k < sectors; ++k) {
            const double azimuth = 2 * kPi * (k + 0.5) / sectors;
            sum += sine * f(axes.to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}));
        }
    }
    return sum * (end - begin) * 2 * kPi / (static_cast<double>(rings) * sectors);
}

void set_luminous_parts(const LineLight& light, const Double3& axis, EmissionProfile& profile) {
    const double section = 2 * double{light.radius} * length(axis_of(light));
    if (light.model == TubeModel::strip) {
        profile.faces = {{{0, 0, 1}, section}, {{0, 0, -1}, section}};
        return;
    }
    profile.round = {axis, section};
    const double cap = kPi * double{light.radius} * double{light.radius};
    if (light.model == TubeModel::solid) profile.faces = {{axis, cap}, {-1.0 * axis, cap}};
}

/// The flux of the luminaire that does not leave because the visible area counts as a larger one [lm]. \param axis of the light
double lost_flux(const EmissionProfile& profile, const Double3& axis) {
    const auto lost = [&](const Double3& w) {
        const double emitted = visible_area(profile, w) / effective_area(profile, w);
        return (1 - emitted) * profile.luminaire->profile.intensity(w);
    };
    // Tubes are seen least along their axis, or from the side if they are flat; strips from their edges.
    constexpr int kRings = 150;
    const double grazing = std::asin(kGrazingCosine);
    const auto sideways = [&](const Axes& axes) {
        return band_integral(axes, kPi / 2 - grazing, kPi / 2 + grazing, kRings, lost);
    };
    if (!(profile.round.area > 0)) return sideways(around({0, 0, 1}));
    const Axes axes = around(axis);
    return band_integral(axes, 0, grazing, kRings, lost) +
           band_integral(axes, kPi - grazing, kPi, kRings, lost) + sideways(axes);
}

/// The integral of the luminance of the profile that passes the spread, over the directions and the area that they see.
double spread_flux(const EmissionProfile& profile, double slope) {
    constexpr int kRings = 400;
    const double widest = std::atan(slope);
    double flux = 0;
    for (const LuminousFace& face : profile.faces) {
        const auto emitted = [&](const Double3& w) {
            return dot(face.normal, w) * passed_share(profile, face.normal, w) *
                   luminance_of_profile(profile, w);
        };
        flux += face.area * band_integral(around(face.normal), 0, widest, kRings, emitted);
    }
    if (!(profile.round.area > 0)) return flux;
    const Double3& axis = profile.round.axis;
    const TubeSpread table = tube_spread(slope);
    const auto emitted = [&](const Double3& w) {
        const double along = dot(axis, w);
        const double sine = std::sqrt(1 - along * along);
        return sine * passed_share_of_tube(table, std::fabs(along) / (sine * slope)) *
               luminance_of_profile(profile, w);
    };
    return flux + profile.round.area *
                      band_integral(around(axis), kPi / 2 - widest, kPi / 2 + widest, kRings, emitted);
}

} // namespace

ProfilePlacement place_profile(const LineLight& light, const ProfiledEmission& emission) {
    const Axes line = axes_of(light);
    const Axes profile =
        Axes::of(line.to_world(to_double(emission.x_axis)), line.to_world(to_double(emission.z_axis)));
    return {profile.x, profile.y, profile.z, line.z};
}

ProfiledShape profile_line(const LineLight& light, const ProfileRequest& request) {
    const Axes line = axes_of(light);
    const Axes frame = line.turned(request.angle);
    const Double3 axis = frame.to_local(line.x);
    EmissionProfile profile{request.luminaire, request.spread};
    const std::optional<double> slope = spread_slope(profile);
    ProfiledShape shape;
    ProfiledEmission& emission = shape.emissions.emplace_back();
    emission.x_axis = to_float(line.to_local(frame.x));
    emission.z_axis = to_float(line.to_local(frame.z));
    emission.mean = static_cast<float>(passed_flux(profile));
    if (request.luminaire != nullptr) {
        set_luminous_parts(light, axis, profile);
        const double whole = request.luminaire->profile.flux();
        const double flux = std::max(whole - lost_flux(profile, axis), 0.0);
        profile.lost = whole > 0 ? std::clamp(1 - flux / whole, 0.0, 1.0) : 0;
        const double all = kPi * area(light);
        shape.radiance = {flux / (all * kLumensPerWatt)};
        const double mean = (slope ? spread_flux(profile, *slope) : flux) / all;
        emission.mean = static_cast<float>(mean < kDarkest ? 0 : mean);
    }
    emission.profile = std::make_shared<const EmissionProfile>(std::move(profile));
    return shape;
}

/// With the angle a between direction and axis, the share is the mean over azimuths b from the plane of both, weighted by their
/// cosine, of 1 - tan(angle from the normal) / slope. The cosine of that angle is sin a cos b.
TubeSpread tube_spread(double slope) {
    TubeSpread table{};
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
        const double cotangent = slope * static_cast<double>(i) / static_cast<double>(table.size() - 1);
        const double sine = 1 / std::sqrt(1 + cotangent * cotangent);
        // Where the angle from the normal reaches that of the spread.
        const double widest = std::acos(std::min(1 / (sine * std::sqrt(1 + slope * slope)), 1.0));
        constexpr int kSteps = 200;
        double sum = 0;
        for (int k = 0; k < kSteps; ++k) {
            const double azimuth = widest * (k + 0.5) / kSteps;
            const double cosine = sine * std::cos(azimuth);
            sum += std::max(std::cos(azimuth) - std::sqrt(1 - cosine * cosine) / (sine * slope), 0.0);
        }
        table[i] = static_cast<float>(sum * widest / kSteps);
    }
    return table;
}

double passed_share_of_tube(const TubeSpread& table, double cotangent) {
    const double at = cotangent * static_cast<double>(table.size() - 1);
    if (!(at < static_cast<double>(table.size() - 1))) return 0;
    const auto i = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(i);
    return (1 - share) * double{table[i]} + share * double{table[i + 1]};
}

Float3 perpendicular_to_line(const LineLight& light, const Double3& vector) {
    const Double3 axis = normalized(axis_of(light));
    Double3 across = vector - dot(vector, axis) * axis;
    if (!(length(across) > 1e-3 * length(vector))) {
        const Double3 other = std::fabs(axis.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0};
        across = other - dot(other, axis) * axis;
    }
    return to_float(normalized(across));
}

} // namespace nusselt::scene
