#include "scene/import/ies/ies_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Half-planes of type C, before they are mirrored. Angles in degrees.
struct HalfPlanes {
    std::vector<double> vertical, horizontal;
    std::vector<double> candelas;
};

/// The horizontal angles at which a half-plane appears, some perhaps twice.
std::vector<double> mirror_images(double h, ProfileSymmetry symmetry) {
    switch (symmetry) {
    case ProfileSymmetry::none:
        return {h};
    case ProfileSymmetry::rotational:
        return {0};
    case ProfileSymmetry::plane_0:
        return {h, -h};
    case ProfileSymmetry::plane_90:
        return {h, 180 - h};
    case ProfileSymmetry::quadrants:
        break;
    }
    return {h, 180 - h, 180 + h, -h};
}

IntensityProfile mirrored(const HalfPlanes& planes, ProfileSymmetry symmetry) {
    std::vector<std::pair<double, std::size_t>> rows; // horizontal angle, row of the file
    for (std::size_t row = 0; row < planes.horizontal.size(); ++row)
        for (const double image : mirror_images(planes.horizontal[row], symmetry)) {
            const double wrapped = image < 0 ? image + 360 : image;
            rows.emplace_back(wrapped >= 360 ? wrapped - 360 : wrapped, row);
        }
    std::sort(rows.begin(), rows.end());
    // 360 is 0 again, and half-planes in a mirror are their own images, up to rounding.
    constexpr double kSame = 1e-6;
    const auto is_same = [](const auto& a, const auto& b) { return b.first - a.first < kSame; };
    rows.erase(std::unique(rows.begin(), rows.end(), is_same), rows.end());
    while (rows.size() > 1 && rows.back().first > 360 - kSame) rows.pop_back();

    IntensityTable table;
    for (const double v : planes.vertical)
        table.vertical.push_back(v == 180 ? std::numbers::pi : v * kDegree);
    for (const auto& [h, row] : rows) {
        table.horizontal.push_back(h * kDegree);
        const auto first =
            planes.candelas.begin() + static_cast<std::ptrdiff_t>(row * planes.vertical.size());
        table.candelas.insert(table.candelas.end(), first,
                              first + static_cast<std::ptrdiff_t>(planes.vertical.size()));
    }
    return IntensityProfile(std::move(table));
}

/// An interval of a list of angles, and where in it an angle lies.
struct Place {
    std::size_t index;
    double part;
};

/// The place of an angle, nothing if it is outside of the list.
std::optional<Place> place_of(const std::vector<double>& angles, double angle) {
    constexpr double kRounding = 1e-6;
    if (!(angle >= angles.front() - kRounding && angle <= angles.back() + kRounding)) return std::nullopt;
    const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const auto index = static_cast<std::size_t>(above - angles.begin()) - 1;
    const double part = (angle - angles[index]) / (angles[index + 1] - angles[index]);
    return Place{index, std::clamp(part, 0.0, 1.0)};
}

/// The intensity of a file of type A or B in a direction.
double intensity_of(const IesFile& file, const Double3& w) {
    const auto arc = [](double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)) / kDegree; };
    const bool is_a = file.type == PhotometricType::a;
    double v = is_a ? arc(w.x) : std::atan2(w.x, w.z) / kDegree;
    double h = is_a ? std::atan2(w.y, w.z) / kDegree : arc(w.y);
    if (file.vertical.front() == 0) v = std::fabs(v);
    if (file.horizontal.front() == 0) h = std::fabs(h);
    const auto at_v = place_of(file.vertical, v);
    const auto at_h = place_of(file.horizontal, h);
    if (!at_v || !at_h) return 0;
    const double* row = file.candelas.data() + at_h->index * file.vertical.size() + at_v->index;
    const double* next = row + file.vertical.size();
    const auto along = [&](const double* pair) { return (1 - at_v->part) * pair[0] + at_v->part * pair[1]; };
    return (1 - at_h->part) * along(row) + at_h->part * along(next);
}

/// Equal steps from begin to end, none larger than `step`.
std::vector<double> steps(double begin, double end, double step) {
    const auto count = static_cast<std::size_t>(std::ceil((end - begin) / step - 1e-9));
    std::vector<double> angles;
    for (std::size_t i = 0; i <= count; ++i)
        angles.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(count));
    return angles;
}

double smallest_step(const std::vector<double>& angles) {
    double step = 360;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) step = std::min(step, angles[i + 1] - angles[i]);
    return step;
}

HalfPlanes resampled(const IesFile& file) {
    constexpr double kFinest = 0.25, kCoarsest = 1;
    const double step = std::clamp(std::min(smallest_step(file.vertical), smallest_step(file.horizontal)),
                                   kFinest, kCoarsest);
    // The angles of planes around the axis; beyond 90 degrees they lead behind the luminaire.
    const std::vector<double>& around = file.type == PhotometricType::a ? file.horizontal : file.vertical;
    const bool is_in_front = around.front() >= -90 && around.back() <= 90;
    HalfPlanes planes;
    planes.vertical = steps(0, is_in_front ? 90 : 180, step);
    switch (file.symmetry) {
    case ProfileSymmetry::quadrants:
        planes.horizontal = steps(0, 90, step);
        break;
    case ProfileSymmetry::plane_0:
        planes.horizontal = steps(0, 180, step);
        break;
    case ProfileSymmetry::plane_90:
        planes.horizontal = steps(90, 270, step);
        break;
    case ProfileSymmetry::none:
    case ProfileSymmetry::rotational:
        planes.horizontal = steps(0, 360, step);
    }
    for (const double h : planes.horizontal)
        for (const double v : planes.vertical) {
            const double radius = std::sin(v * kDegree);
            planes.candelas.push_back(
                intensity_of(file, {radius * std::cos(h * kDegree), -radius * std::sin(h * kDegree),
                                    std::cos(v * kDegree)}));
        }
    return planes;
}

} // namespace

IntensityProfile make_profile(const IesFile& file) {
    const HalfPlanes planes = file.type == PhotometricType::c
                                  ? HalfPlanes{file.vertical, file.horizontal, file.candelas}
                                  : resampled(file);
    return mirrored(planes, file.symmetry);
}

} // namespace nusselt::scene
