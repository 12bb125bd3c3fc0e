#include "scene/model/profiles/emission_profile.h"

#include "scene/model/polygon.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/spread.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr double kPi = std::numbers::pi;

/// The cosine between normals that count as one.
constexpr double kSameNormal = 1 - 1e-6;

/// The frame of a polygon with one of its edges along x.
Axes axes_of(const PolygonLight& light, std::size_t edge = 0) {
    std::vector<Double3> corners;
    for (const Float3& p : light.vertices) corners.push_back(to_double(p));
    return Axes::of(corners[(edge + 1) % corners.size()] - corners[edge], area_vector(corners));
}

/// The mean over projected solid angle of a function of directions, z being the normal: the midpoint rule in polar
/// coordinates up to an angle from the normal [rad], relative to the whole hemisphere.
template <class Function>
double hemisphere_mean(double largest_angle, const Function& f) {
    constexpr int kRings = 360;
    constexpr int kSectors = 360;
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
        const double angle = largest_angle * (i + 0.5) / kRings;
        const double cosine = std::cos(angle);
        const double sine = std::sin(angle);
        double ring = 0;
        for (int k = 0; k < kSectors; ++k) {
            const double azimuth = 2 * kPi * (k + 0.5) / kSectors;
            ring += f(Double3{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
        }
        sum += ring * cosine * sine;
    }
    return 2 * sum * largest_angle / (double{kRings} * kSectors);
}

/// The same for a function that is dark beyond the slopes of a honeycomb: the midpoint rule in the angles of both slopes, in
/// place of angles from the normal, which would miss narrow ones.
template <class Function>
double honeycomb_mean(const std::array<double, 2>& slopes, const Function& f) {
    constexpr int kSteps = 400;
    const double width = std::atan(slopes[0]);
    const double height = std::atan(slopes[1]);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double p = std::tan(width * (2 * (i + 0.5) / kSteps - 1));
        for (int k = 0; k < kSteps; ++k) {
            const double q = std::tan(height * (2 * (k + 0.5) / kSteps - 1));
            const double squared = 1 / (1 + p * p + q * q);
            const double cosine = std::sqrt(squared);
            sum += (1 + p * p) * (1 + q * q) * squared * squared * f(Double3{p * cosine, q * cosine, cosine});
        }
    }
    return sum * 4 * width * height / (kPi * kSteps * kSteps);
}

RadialSpread<double> radial_spread(double slope) { return {slope}; }

/// The mean of what a face emits, if the spread has no effect.
double unspread_mean(const EmissionProfile& profile, const Axes& face_in_profile) {
    if (profile.luminaire == nullptr) return 1;
    const IntensityProfile& intensity = profile.luminaire->profile;
    // Flat lights have a closed form.
    if (profile.faces.size() == 1)
        return (1 - share_lost_by_flat_light(intensity)) * intensity.flux() / (kPi * profile.faces[0].area);
    return hemisphere_mean(kPi / 2, [&](const Double3& w) {
        return luminance_of_profile(profile, face_in_profile.to_world(w));
    });
}

/// \param face the axes of the face in the frame of the profile, with x as honeycomb_direction() says
double spread_mean(const EmissionProfile& profile, const Axes& face) {
    const auto slope = spread_slope(profile);
    const auto holes = honeycomb_slopes(profile);
    if (!slope && !holes) return unspread_mean(profile, face);
    if (profile.luminaire == nullptr) return passed_flux(profile);
    const auto emitted = [&](const Double3& w) {
        const Double3 direction = face.to_world(w);
        return passed_share(profile, face.z, direction) * luminance_of_profile(profile, direction);
    };
    return holes ? honeycomb_mean(*holes, emitted) : hemisphere_mean(std::atan(*slope), emitted);
}

/// Means by the normals of a shape, in the frame of its profile: shapes may have a million polygons.
class FaceMeans {
public:
    struct Means {
        double spread, unspread;
    };

    explicit FaceMeans(const EmissionProfile& profile) : profile_(profile) {}

    Means of(const Double3& normal) {
        // Only profiles distinguish normals.
        for (const auto& [known, means] : means_)
            if (profile_.luminaire == nullptr || dot(known, normal) > kSameNormal) return means;
        const Axes face = Axes::of(honeycomb_direction(normal), normal);
        means_.emplace_back(normal, Means{spread_mean(profile_, face), unspread_mean(profile_, face)});
        return means_.back().second;
    }

private:
    const EmissionProfile& profile_;
    std::vector<std::pair<Double3, Means>> means_;
};

/// The areas of the normals of a shape, in the frame of its profile.
std::vector<LuminousFace> faces_of(std::span<const PolygonLight> lights, const Axes& frame) {
    std::vector<LuminousFace> faces;
    const auto add = [&](const Double3& normal, double face_area) {
        const auto found = std::find_if(faces.begin(), faces.end(), [&](const LuminousFace& face) {
            return dot(face.normal, normal) > kSameNormal;
        });
        if (found != faces.end())
            found->area += face_area;
        else
            faces.push_back({normal, face_area});
    };
    for (const PolygonLight& light : lights) {
        const Double3 normal = frame.to_local(axes_of(light).z);
        add(normal, area(light));
        if (light.two_sided) add(-1.0 * normal, area(light));
        if (faces.size() > kMostLuminousFaces) break;
    }
    return faces;
}

} // namespace

Axes Axes::of(const Double3& along_x, const Double3& along_z) {
    const Double3 z = normalized(along_z);
    const Double3 x = normalized(along_x - dot(along_x, z) * z);
    return {x, cross(z, x), z};
}

Axes Axes::turned(double angle) const {
    const double turn = angle * (kPi / 180);
    return of(std::cos(turn) * x + std::sin(turn) * y, z);
}

bool has_effect(const ProfileRequest& request) {
    return request.luminaire != nullptr || request.spread < kWidestSpread ||
           request.honeycomb != HoneycombAngles{};
}

ProfilePlacement place_profile(const PolygonLight& light, const ProfiledEmission& emission) {
    const Axes polygon = axes_of(light);
    const Axes profile =
        Axes::of(polygon.to_world(to_double(emission.x_axis)), polygon.to_world(to_double(emission.z_axis)));
    return {profile.x, profile.y, profile.z, polygon.z};
}

double least_visible_area(const EmissionProfile& profile) {
    double largest = profile.round.area;
    for (const LuminousFace& face : profile.faces) largest = std::max(largest, face.area);
    return kGrazingCosine * largest;
}

double visible_area(const EmissionProfile& profile, const Double3& direction) {
    const double along = dot(profile.round.axis, direction);
    double visible = profile.round.area * std::sqrt(std::max(1 - along * along, 0.0));
    for (const LuminousFace& face : profile.faces)
        visible += face.area * std::max(dot(face.normal, direction), 0.0);
    return visible;
}

double effective_area(const EmissionProfile& profile, const Double3& direction) {
    return std::max(visible_area(profile, direction), least_visible_area(profile));
}

double luminance_of_profile(const EmissionProfile& profile, const Double3& direction) {
    if (profile.luminaire == nullptr) return 1;
    return profile.luminaire->profile.intensity(direction) / effective_area(profile, direction);
}

std::optional<double> spread_slope(const EmissionProfile& profile) {
    if (!(profile.spread < kWidestSpread)) return std::nullopt;
    return std::tan(profile.spread * (kPi / 360));
}

std::optional<std::array<double, 2>> honeycomb_slopes(const EmissionProfile& profile) {
    if (profile.honeycomb == HoneycombAngles{}) return std::nullopt;
    const auto slope = [](double angle) {
        return angle < kWidestSpread ? std::tan(angle * (kPi / 360))
                                     : std::numeric_limits<double>::infinity();
    };
    return std::array{slope(profile.honeycomb.along), slope(profile.honeycomb.across)};
}

Double3 honeycomb_direction(const Double3& normal) {
    return std::fabs(normal.x) < 0.9 ? Double3{1, 0, 0} : Double3{0, 1, 0};
}

Double3 honeycomb_axis(const ProfilePlacement& placement) {
    const Axes frame{placement.x_axis, placement.y_axis, placement.z_axis};
    const Double3 direction = honeycomb_direction(frame.to_local(placement.normal));
    return Axes::of(frame.to_world(direction), placement.normal).x;
}

double passed_share(const EmissionProfile& profile, const Double3& normal, const Double3& direction) {
    const double cosine = dot(normal, direction);
    if (const auto holes = honeycomb_slopes(profile)) {
        const Axes face = Axes::of(honeycomb_direction(normal), normal);
        const auto along = [&](const Double3& axis, double slope) {
            return std::max(1 - std::fabs(dot(axis, direction)) / (cosine * slope), 0.0);
        };
        return cosine > 0 ? along(face.x, (*holes)[0]) * along(face.y, (*holes)[1]) : 0;
    }
    const std::optional<double> slope = spread_slope(profile);
    if (!slope) return 1;
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    return radial_spread(*slope).share({sine, 0, cosine});
}

double passed_flux(const EmissionProfile& profile) {
    if (const auto holes = honeycomb_slopes(profile))
        return Honeycomb<double>{{(*holes)[0], (*holes)[1]}}.flux_share();
    const std::optional<double> slope = spread_slope(profile);
    return slope ? radial_spread(*slope).flux_share() : 1;
}

std::optional<ProfiledShape> profile_shape(std::span<const PolygonLight> lights, std::size_t first_edge,
                                           const ProfileRequest& request) {
    const Axes frame = axes_of(lights.front(), first_edge).turned(request.angle);
    EmissionProfile profile{request.luminaire, request.spread, request.honeycomb};
    if (request.luminaire != nullptr) {
        profile.faces = faces_of(lights, frame);
        if (profile.faces.size() > kMostLuminousFaces) return std::nullopt;
    }

    ProfiledShape shape;
    FaceMeans means(profile);
    double flux = 0;
    for (const PolygonLight& light : lights) {
        const Axes polygon = axes_of(light);
        const Double3 normal = frame.to_local(polygon.z);
        FaceMeans::Means mean = means.of(normal);
        if (light.two_sided) {
            const FaceMeans::Means back = means.of(-1.0 * normal);
            mean = {0.5 * (mean.spread + back.spread), 0.5 * (mean.unspread + back.unspread)};
        }
        ProfiledEmission& emission = shape.emissions.emplace_back();
        emission.x_axis = to_float(polygon.to_local(frame.x));
        emission.z_axis = to_float(polygon.to_local(frame.z));
        emission.mean = static_cast<float>(mean.spread < kDarkest ? 0 : mean.spread);
        if (request.luminaire == nullptr) continue;
        shape.radiance.push_back(mean.unspread / kLumensPerWatt);
        flux += (light.two_sided ? 2 : 1) * kPi * area(light) * mean.unspread;
    }
    if (request.luminaire != nullptr) {
        const double whole = request.luminaire->profile.flux();
        profile.lost = whole > 0 ? std::clamp(1 - flux / whole, 0.0, 1.0) : 0;
    }
    const auto shared = std::make_shared<const EmissionProfile>(std::move(profile));
    for (ProfiledEmission& emission : shape.emissions) emission.profile = shared;
    return shape;
}

} // namespace nusselt::scene
