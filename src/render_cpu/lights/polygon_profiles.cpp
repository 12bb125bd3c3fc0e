#include "render_cpu/lights/polygon_profiles.h"

#include "scene/model/library_vector.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/spread.h>
#include <nusselt/emission/windowed_light.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace nusselt::render_cpu {

namespace {

using scene::Double3;

/// Directions and shares that differ by less have the same table. It gives probabilities only.
constexpr double kSameNumber = 1e-5;

/// Rows and columns of tables. Those of a luminaire resolve 0.7 degrees, those of a spread cover no more than its directions.
constexpr int kLuminaireTexels = 256;
constexpr int kSpreadTexels = 128;
constexpr int kLookups = 2;

/// The frame of a side within that of its profile.
struct SideFrame {
    /// \param along a vector that is to be in the plane of the first axis and the normal
    SideFrame(const Double3& along, const Double3& normal)
        : t(normalized(along - dot(along, normal) * normal)), b(cross(normal, t)), n(normal) {}

    /// Along the half-plane of 0 degrees if there is one.
    static SideFrame of_profile(const Double3& normal) {
        return {scene::honeycomb_direction(normal), normal};
    }
    Double3 to_profile(const Vec3<float>& w) const {
        return double{w.x} * t + double{w.y} * b + double{w.z} * n;
    }

    Double3 t, b, n;
};

bool is_rectangle(const scene::PolygonLight& light) {
    if (light.vertices.size() != 4) return false;
    constexpr double kSquare = 1e-4;
    for (std::size_t i = 0; i < 4; ++i) {
        const Double3 corner = to_double(light.vertices[(i + 1) % 4]);
        const Double3 before = normalized(corner - to_double(light.vertices[i]));
        const Double3 after = normalized(to_double(light.vertices[(i + 2) % 4]) - corner);
        if (!(std::fabs(dot(before, after)) < kSquare)) return false;
    }
    return true;
}

/// Above this number of tables, rectangles no longer have tables along their sides.
constexpr std::size_t kMostTables = 64;

/// The largest intensities of a luminaire by angle from its axis.
class Bands {
public:
    explicit Bands(const scene::IntensityTable& table) : vertical_(table.vertical), peak_(vertical_.size()) {
        for (std::size_t i = 0; i < table.candelas.size(); ++i) {
            double& peak = peak_[i % peak_.size()];
            peak = std::max(peak, table.candelas[i]);
        }
    }
    /// From where on it is dark [rad].
    double end() const {
        std::size_t i = peak_.size() - 1;
        while (i > 0 && peak_[i - 1] == 0 && peak_[i] == 0) --i;
        return vertical_[i];
    }
    /// At least as large as any intensity between two angles [rad].
    double peak(double from, double to) const {
        if (to < vertical_.front() || from > vertical_.back()) return 0;
        const auto first = std::upper_bound(vertical_.begin(), vertical_.end(), from);
        const auto last = std::lower_bound(vertical_.begin(), vertical_.end(), to);
        const auto begin = std::max<std::ptrdiff_t>(first - vertical_.begin() - 1, 0);
        const auto end = std::min<std::ptrdiff_t>(last - vertical_.begin() + 1, std::ssize(vertical_));
        return *std::max_element(peak_.begin() + begin, peak_.begin() + end);
    }

private:
    const std::vector<double>& vertical_;
    std::vector<double> peak_;
};

/// Where a table has to be: around their axis, luminaires are dark beyond their last angle.
RectifiedDomain<float> domain_of(const scene::EmissionProfile& profile, const Double3& normal) {
    if (const auto holes = scene::honeycomb_slopes(profile)) {
        const auto bounded = [](double slope) {
            return static_cast<float>(std::clamp(slope, 1e-6, double{kLargestSlope<float>}));
        };
        const Vec2<float> high{bounded((*holes)[0]), bounded((*holes)[1])};
        return {{-high.x, -high.y}, high};
    }
    double slope = scene::spread_slope(profile).value_or(double{kLargestSlope<float>});
    if (profile.luminaire != nullptr && normal.z > 1 - 1e-6) {
        const double end = Bands(profile.luminaire->profile.table()).end();
        if (end < 1.5) slope = std::min(slope, 1.01 * std::tan(end));
    }
    const auto s = static_cast<float>(std::clamp(slope, 1e-6, double{kLargestSlope<float>}));
    return {{-s, -s}, {s, s}};
}

/// The radiance of a table in proportion. Luminaires may have beams between all lookups, so that every direction whose angle from
/// the axis has light gets a little.
class TableRadiance {
public:
    /// \param texel [rad]
    TableRadiance(const scene::ProfiledEmission& emission, const SideFrame& frame, double texel)
        : profile_(*emission.profile),
          frame_(frame),
          factor_(emission.mean > 0 ? 1 / double{emission.mean} : 0),
          reach_(1.5 * texel) {
        if (profile_.luminaire != nullptr) bands_.emplace(profile_.luminaire->profile.table());
    }

    Vec3<float> operator()(const Vec3<float>& w) const {
        double luminance = 1;
        if (bands_) {
            constexpr double kLittle = 1e-3;
            const Double3 direction = frame_.to_profile(w);
            const double vertical = std::atan2(std::hypot(direction.x, direction.y), direction.z);
            const double peak = bands_->peak(vertical - reach_, vertical + reach_);
            luminance = luminance_of_profile(profile_, direction) +
                        kLittle * peak / effective_area(profile_, direction);
        }
        const auto value =
            static_cast<float>(factor_ * luminance * passed_share(profile_, frame_.n, frame_.to_profile(w)));
        return {value, value, value};
    }

private:
    const scene::EmissionProfile& profile_;
    SideFrame frame_;
    double factor_;
    double reach_; ///< the diagonal of a texel [rad]
    std::optional<Bands> bands_;
};

} // namespace

struct PolygonProfiles::Table {
    Table(const scene::ProfiledEmission& emission, const SideFrame& frame)
        : texels(emission.profile->luminaire != nullptr ? kLuminaireTexels : kSpreadTexels),
          sums(static_cast<std::size_t>(RectifiedTable<float>::size(texels, texels))),
          colour(sums.size()) {
        const RectifiedDomain<float> domain = domain_of(*emission.profile, frame.n);
        const double texel = 2 * std::atan(double{domain.high.x}) / texels;
        table = make_rectified_table(TableRadiance(emission, frame, texel), domain, texels, texels, kLookups,
                                     sums.data(), colour.data());
        // All channels are equal.
        table.colour = nullptr;
        colour = {};
    }

    int texels;
    std::vector<RectifiedSums> sums;
    std::vector<Vec3<float>> colour;
    RectifiedTable<float> table;
};

struct PolygonProfiles::Side {
    Double3 t, b, n; ///< in the frame of the profile
    const RectifiedTable<float>* table;
};

struct PolygonProfiles::Light {
    WindowedLight<float> light;
};

PolygonProfiles::PolygonProfiles() = default;
PolygonProfiles::~PolygonProfiles() = default;

/// A table for a side, in the frame of an edge, or of the profile.
PolygonProfiles::Side PolygonProfiles::side_of(const scene::ProfiledEmission& emission, const Double3& normal,
                                               const Double3* edge) {
    const scene::EmissionProfile& profile = *emission.profile;
    // Windows of honeycombs lie along their holes.
    const bool is_along_edge = edge != nullptr && tables_.size() < kMostTables && !honeycomb_slopes(profile);
    const SideFrame frame = is_along_edge ? SideFrame(*edge, normal) : SideFrame::of_profile(normal);
    std::vector<long> shape;
    const auto add = [&](double number) { shape.push_back(std::lround(number / kSameNumber)); };
    const auto add_direction = [&](const Double3& v) { add(v.x), add(v.y), add(v.z); };
    if (profile.luminaire != nullptr) {
        add_direction(frame.n);
        add_direction(frame.t);
        for (const scene::LuminousFace& face : profile.faces) {
            add_direction(face.normal);
            add(face.area / profile.faces[0].area);
        }
    }
    add(profile.honeycomb.along);
    add(profile.honeycomb.across);
    std::unique_ptr<Table>& table = tables_[{profile.luminaire.get(), profile.spread, std::move(shape)}];
    if (table == nullptr) table = std::make_unique<Table>(emission, frame);
    return {frame.t, frame.b, frame.n, &table->table};
}

std::int32_t PolygonProfiles::add(const scene::Scene& scene, const scene::PolygonLight& light) {
    const scene::ProfiledEmission& emission =
        scene.emission_profiles.at(static_cast<std::size_t>(light.profile));
    const scene::EmissionProfile& profile = *emission.profile;
    const scene::ProfilePlacement placement = scene::place_profile(light, emission);

    PolygonProfile record{records_of_profiles_.make(emission, placement), {}, {}, {}};
    std::vector<Vec3<float>> corners;
    for (const scene::Float3& p : light.vertices) corners.push_back(scene::to_vec(p));
    const auto to_profile = [&](const Double3& v) {
        return Double3{dot(placement.x_axis, v), dot(placement.y_axis, v), dot(placement.z_axis, v)};
    };
    const auto to_world = [&](const Double3& v) {
        return scene::to_vec(
            to_float(v.x * placement.x_axis + v.y * placement.y_axis + v.z * placement.z_axis));
    };
    if (const auto holes = scene::honeycomb_slopes(profile)) {
        record.hole_axis = to_float(scene::honeycomb_axis(placement));
        record.inverse_holes = {static_cast<float>(1 / (*holes)[0]), static_cast<float>(1 / (*holes)[1])};
    }
    const Double3 edge = to_profile(to_double(light.vertices[1]) - to_double(light.vertices[0]));
    const Double3* const aligned = is_rectangle(light) ? &edge : nullptr;
    for (int side = 0; side < (light.two_sided ? 2 : 1); ++side) {
        const Side frame =
            side_of(emission, to_profile((side == 0 ? 1.0 : -1.0) * placement.normal), aligned);
        lights_.push_back(std::make_unique<Light>(
            Light{make_profiled_light({to_world(frame.t), to_world(frame.b), to_world(frame.n)},
                                      corners.data(), static_cast<int>(corners.size()), *frame.table)}));
        record.side[side] = &lights_.back()->light;
    }
    records_.push_back(record);
    return static_cast<std::int32_t>(records_.size() - 1);
}

} // namespace nusselt::render_cpu
