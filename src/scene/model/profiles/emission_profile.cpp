#include "scene/model/profiles/emission_profile.h"

#include "scene/model/polygon.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/spread.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr double kPi = std::numbers::pi;

/// The cosine between normals that count as one.
constexpr double kSameNormal = 1 - 1e-6;

/// Right-handed and orthonormal.
struct Axes {
    Double3 x, y, z;

    Double3 to_local(const Double3& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
    Double3 to_world(const Double3& v) const { return v.x * x + v.y * y + v.z * z; }
};

Axes make_axes(const Double3& along_x, const Double3& along_z) {
    const Double3 z = normalized(along_z);
    const Double3 x = normalized(along_x - dot(along_x, z) * z);
    return {x, cross(z, x), z};
}

/// The frame of a polygon with one of its edges along x.
Axes axes_of(const PolygonLight& light, std::size_t edge = 0) {
    std::vector<Double3> corners;
    for (const Float3& p : light.vertices) corners.push_back(to_double(p));
    return make_axes(corners[(edge + 1) % corners.size()] - corners[edge], area_vector(corners));
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

double spread_mean(const EmissionProfile& profile, const Axes& face_in_profile) {
    const std::optional<double> slope = spread_slope(profile);
    if (!slope) return unspread_mean(profile, face_in_profile);
    if (profile.luminaire == nullptr) return radial_spread(*slope).flux_share();
    return hemisphere_mean(std::atan(*slope), [&](const Double3& w) {
        return passed_share(profile, w.z) * luminance_of_profile(profile, face_in_profile.to_world(w));
    });
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
        const Axes face = make_axes(std::fabs(normal.x) < 0.7 ? Double3{1, 0, 0} : Double3{0, 1, 0}, normal);
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

ProfilePlacement place_profile(const PolygonLight& light, const ProfiledEmission& emission) {
    const Axes polygon = axes_of(light);
    const Axes profile =
        make_axes(polygon.to_world(to_double(emission.x_axis)), polygon.to_world(to_double(emission.z_axis)));
    return {profile.x, profile.y, profile.z, polygon.z};
}

double least_visible_area(const EmissionProfile& profile) {
    double largest = 0;
    for (const LuminousFace& face : profile.faces) largest = std::max(largest, face.area);
    return kGrazingCosine * largest;
}

double visible_area(const EmissionProfile& profile, const Double3& direction) {
    double visible = 0;
    for (const LuminousFace& face : profile.faces)
        visible += face.area * std::max(dot(face.normal, direction), 0.0);
    return std::max(visible, least_visible_area(profile));
}

double luminance_of_profile(const EmissionProfile& profile, const Double3& direction) {
    if (profile.luminaire == nullptr) return 1;
    return profile.luminaire->profile.intensity(direction) / visible_area(profile, direction);
}

std::optional<double> spread_slope(const EmissionProfile& profile) {
    if (!(profile.spread < kWidestSpread)) return std::nullopt;
    return std::tan(profile.spread * (kPi / 360));
}

double passed_share(const EmissionProfile& profile, double cosine) {
    const std::optional<double> slope = spread_slope(profile);
    if (!slope) return 1;
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    return radial_spread(*slope).share({sine, 0, cosine});
}

std::optional<ProfiledShape> profile_shape(std::span<const PolygonLight> lights, std::size_t first_edge,
                                           const ProfileRequest& request) {
    const Axes plain = axes_of(lights.front(), first_edge);
    const double turn = request.angle * (kPi / 180);
    const Axes frame = make_axes(std::cos(turn) * plain.x + std::sin(turn) * plain.y, plain.z);
    EmissionProfile profile{request.luminaire, request.spread, {}, 0};
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
        emission.mean = static_cast<float>(mean.spread);
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
