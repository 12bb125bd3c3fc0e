#include "render_cpu/lights/polygon_profiles.h"

#include "scene/model/library_vector.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/spread.h>
#include <nusselt/emission/windowed_light.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace nusselt::render_cpu {

namespace {

using scene::Double3;

/// Directions and shares that differ by less have the same table. It gives probabilities only.
constexpr double kSameNumber = 1e-5;

/// Rows and columns of tables. Those of a luminaire resolve 0.7 degrees, those of a spread cover no more than its directions.
constexpr int kLuminaireTexels = 256;
constexpr int kSpreadTexels = 128;
constexpr int kLookups = 2;

/// The frame of a side within that of its profile: along the half-plane of 0 degrees if it can, so that the sides of rectangles
/// and boxes are along its axes.
struct SideFrame {
    explicit SideFrame(const Double3& normal) : n(normal) {
        const Double3 reference = std::fabs(n.x) < 0.9 ? Double3{1, 0, 0} : Double3{0, 1, 0};
        t = normalized(reference - dot(reference, n) * n);
        b = cross(n, t);
    }
    Double3 to_profile(const Vec3<float>& w) const {
        return double{w.x} * t + double{w.y} * b + double{w.z} * n;
    }

    Double3 t, b, n;
};

/// Where a table has to be: around their axis, luminaires are dark beyond their last angle.
RectifiedDomain<float> domain_of(const scene::EmissionProfile& profile, const Double3& normal) {
    double slope = scene::spread_slope(profile).value_or(double{kLargestSlope<float>});
    if (profile.luminaire != nullptr && normal.z > 1 - 1e-6) {
        const double last = profile.luminaire->profile.table().vertical.back();
        if (last < 1.5) slope = std::min(slope, 1.01 * std::tan(last));
    }
    const auto s = static_cast<float>(std::clamp(slope, 1e-6, double{kLargestSlope<float>}));
    return {{-s, -s}, {s, s}};
}

} // namespace

struct PolygonProfiles::Table {
    Table(const scene::ProfiledEmission& emission, const Double3& normal)
        : texels(emission.profile->luminaire != nullptr ? kLuminaireTexels : kSpreadTexels),
          sums(static_cast<std::size_t>(RectifiedTable<float>::size(texels, texels))),
          colour(sums.size()) {
        const scene::EmissionProfile& profile = *emission.profile;
        const SideFrame frame(normal);
        const double factor = emission.mean > 0 ? 1 / double{emission.mean} : 0;
        const auto radiance = [&](const Vec3<float>& w) {
            const auto value = static_cast<float>(factor * passed_share(profile, double{w.z}) *
                                                  luminance_of_profile(profile, frame.to_profile(w)));
            return Vec3<float>{value, value, value};
        };
        table = make_rectified_table(radiance, domain_of(profile, normal), texels, texels, kLookups,
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

const PolygonProfiles::Table& PolygonProfiles::table_of(const scene::ProfiledEmission& emission,
                                                        const Double3& normal) {
    const scene::EmissionProfile& profile = *emission.profile;
    std::vector<long> shape;
    const auto add = [&](double number) { shape.push_back(std::lround(number / kSameNumber)); };
    const auto add_direction = [&](const Double3& v) { add(v.x), add(v.y), add(v.z); };
    if (profile.luminaire != nullptr) {
        add_direction(normal);
        for (const scene::LuminousFace& face : profile.faces) {
            add_direction(face.normal);
            add(face.area / profile.faces[0].area);
        }
    }
    std::unique_ptr<Table>& table = tables_[{profile.luminaire.get(), profile.spread, std::move(shape)}];
    if (table == nullptr) table = std::make_unique<Table>(emission, normal);
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

    std::vector<Vec3<float>> corners;
    for (const scene::Float3& p : light.vertices) corners.push_back(scene::to_vec(p));
    const auto to_profile = [&](const Double3& v) {
        return Double3{dot(placement.x_axis, v), dot(placement.y_axis, v), dot(placement.z_axis, v)};
    };
    const auto to_world = [&](const Double3& v) {
        return scene::to_vec(
            to_float(v.x * placement.x_axis + v.y * placement.y_axis + v.z * placement.z_axis));
    };
    for (int side = 0; side < (light.two_sided ? 2 : 1); ++side) {
        const Double3 normal = to_profile((side == 0 ? 1.0 : -1.0) * placement.normal);
        const SideFrame frame(normal);
        sides_.push_back(std::make_unique<Side>(Side{
            make_profiled_light({to_world(frame.t), to_world(frame.b), to_world(frame.n)}, corners.data(),
                                static_cast<int>(corners.size()), table_of(emission, normal).table)}));
        record.side[side] = &sides_.back()->light;
    }
    records_.push_back(record);
    return static_cast<std::int32_t>(records_.size() - 1);
}

} // namespace nusselt::render_cpu
