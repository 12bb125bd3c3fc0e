#include "render_cpu/lights/polygon_profiles.h"

#include "scene/model/library_vector.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/spread.h>
#include <nusselt/emission/windowed_light.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace nusselt::render_cpu {

namespace {

using scene::Double3;

/// Rotations that differ by less have the same table. It gives probabilities only.
constexpr double kSameRotation = 1e-5;

/// Rows and columns of tables. Those of a luminaire resolve 0.7 degrees, those of a spread cover no more than its directions.
constexpr int kLuminaireTexels = 256;
constexpr int kSpreadTexels = 128;
constexpr int kLookups = 2;

/// Where a table has to be: in a flat light along its axis, luminaires are dark beyond their last angle.
RectifiedDomain<float> domain_of(const scene::ProfiledEmission& emission, int side) {
    const scene::EmissionProfile& profile = *emission.profile;
    double slope = scene::spread_slope(profile).value_or(kLargestSlope<float>);
    const bool is_along_axis = emission.z_axis.z > 1 - 1e-6f && side == 0;
    if (profile.luminaire != nullptr && is_along_axis) {
        const double last = profile.luminaire->profile.table().vertical.back();
        if (last < 1.5) slope = std::min(slope, 1.01 * std::tan(last));
    }
    const auto s = static_cast<float>(std::clamp(slope, 1e-6, double{kLargestSlope<float>}));
    return {{-s, -s}, {s, s}};
}

} // namespace

struct PolygonProfiles::Table {
    Table(const scene::ProfiledEmission& emission, int side)
        : texels(emission.profile->luminaire != nullptr ? kLuminaireTexels : kSpreadTexels),
          sums(static_cast<std::size_t>(RectifiedTable<float>::size(texels, texels))),
          colour(sums.size()) {
        const scene::EmissionProfile& profile = *emission.profile;
        const Double3 x = to_double(emission.x_axis);
        const Double3 z = to_double(emission.z_axis);
        const Double3 y = cross(z, x);
        const double turned = side == 0 ? 1 : -1;
        const double factor = emission.mean > 0 ? 1 / double{emission.mean} : 0;
        const auto radiance = [&](const Vec3<float>& w) {
            const Double3 in_polygon = {w.x, turned * w.y, turned * w.z};
            const Double3 in_profile = {dot(x, in_polygon), dot(y, in_polygon), dot(z, in_polygon)};
            const auto value = static_cast<float>(factor * passed_share(profile, w.z) *
                                                  luminance_of_profile(profile, in_profile));
            return Vec3<float>{value, value, value};
        };
        table = make_rectified_table(radiance, domain_of(emission, side), texels, texels, kLookups,
                                     sums.data(), colour.data());
    }

    int texels;
    std::vector<RectifiedSums> sums;
    std::vector<Vec3<float>> colour;
    RectifiedTable<float> table;
};

struct PolygonProfiles::Side {
    WindowedLight<float> light;
};

PolygonProfiles::PolygonProfiles() = default;
PolygonProfiles::~PolygonProfiles() = default;

const PolygonProfiles::Table& PolygonProfiles::table_of(const scene::ProfiledEmission& emission, int side) {
    std::array<long, 6> rotation{};
    const float entries[] = {emission.x_axis.x, emission.x_axis.y, emission.x_axis.z,
                             emission.z_axis.x, emission.z_axis.y, emission.z_axis.z};
    for (std::size_t i = 0; i < rotation.size(); ++i) rotation[i] = std::lround(entries[i] / kSameRotation);
    std::unique_ptr<Table>& table = tables_[{emission.profile.get(), rotation, side, emission.mean}];
    if (table == nullptr) table = std::make_unique<Table>(emission, side);
    return *table;
}

std::int32_t PolygonProfiles::add(const scene::Scene& scene, const scene::PolygonLight& light) {
    const scene::ProfiledEmission& emission =
        scene.emission_profiles.at(static_cast<std::size_t>(light.profile));
    const scene::EmissionProfile& profile = *emission.profile;
    const scene::ProfilePlacement placement = scene::place_profile(light, emission);

    PolygonProfile record{};
    record.x_axis = to_float(placement.x_axis);
    record.y_axis = to_float(placement.y_axis);
    record.z_axis = to_float(placement.z_axis);
    record.normal = to_float(placement.normal);
    if (const std::optional<double> slope = scene::spread_slope(profile))
        record.inverse_slope = static_cast<float>(1 / *slope);
    record.inverse_mean = emission.mean > 0 ? 1 / emission.mean : 0.0f;
    if (profile.luminaire != nullptr) {
        // With areas relative to the least one and intensities over this, all numbers are of the order of the luminance.
        const double unit = least_visible_area(profile);
        record.luminaire = luminaires_.add(profile.luminaire, unit);
        std::vector<LuminousFaceRecord>& faces = faces_.emplace_back();
        for (const scene::LuminousFace& face : profile.faces)
            faces.push_back({to_float(face.normal), static_cast<float>(face.area / unit)});
        record.faces = faces.data();
        record.face_count = static_cast<std::int32_t>(faces.size());
        record.least_area = 1;
    }

    const Double3 first = to_double(light.vertices[0]);
    const Double3 t = normalized(to_double(light.vertices[1]) - first);
    const Double3 b = cross(placement.normal, t);
    std::vector<Vec3<float>> corners;
    for (const scene::Float3& p : light.vertices) corners.push_back(scene::to_vec(p));
    for (int side = 0; side < (light.two_sided ? 2 : 1); ++side) {
        const double turned = side == 0 ? 1 : -1;
        const auto axis = [](const Double3& v) { return scene::to_vec(to_float(v)); };
        const Frame<float> frame{axis(t), axis(turned * b), axis(turned * placement.normal)};
        sides_.push_back(std::make_unique<Side>(Side{make_profiled_light(
            frame, corners.data(), static_cast<int>(corners.size()), table_of(emission, side).table)}));
        record.side[side] = &sides_.back()->light;
    }
    records_.push_back(record);
    return static_cast<std::int32_t>(records_.size() - 1);
}

} // namespace nusselt::render_cpu
