#include "scene/build/polygons/polygon_triangulation.h"

#include "scene/model/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace nusselt::scene {

namespace {

struct Double2 {
    double x, y;
};

/// Twice the area of a triangle, positive if it is counter-clockwise.
double signed_area(const Double2& a, const Double2& b, const Double2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Along the axis that keeps most of the area, such that the outline is counter-clockwise.
std::vector<Double2> project(const std::vector<Double3>& corners) {
    const Double3 normal = area_vector(corners);
    const double x = std::fabs(normal.x);
    const double y = std::fabs(normal.y);
    const double z = std::fabs(normal.z);
    std::vector<Double2> result;
    result.reserve(corners.size());
    for (const Double3& p : corners) {
        if (z >= x && z >= y)
            result.push_back(normal.z >= 0 ? Double2{p.x, p.y} : Double2{p.y, p.x});
        else if (y >= x)
            result.push_back(normal.y >= 0 ? Double2{p.z, p.x} : Double2{p.x, p.z});
        else
            result.push_back(normal.x >= 0 ? Double2{p.y, p.z} : Double2{p.z, p.y});
    }
    return result;
}

class EarClipper {
public:
    explicit EarClipper(const std::vector<Double2>& corners);
    std::vector<Triangle> run();

private:
    bool is_convex(std::uint32_t i) const {
        return signed_area(corners_[previous_[i]], corners_[i], corners_[next_[i]]) > 0;
    }
    bool is_ear(std::uint32_t i) const;
    std::uint32_t find_ear(std::uint32_t begin) const;

    const std::vector<Double2>& corners_;
    std::vector<std::uint32_t> previous_, next_; ///< of what is left of the outline
    std::vector<bool> is_ear_;
};

EarClipper::EarClipper(const std::vector<Double2>& corners) : corners_(corners) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        previous_.push_back((i + n - 1) % n);
        next_.push_back((i + 1) % n);
    }
    for (std::uint32_t i = 0; i < n; ++i) is_ear_.push_back(is_ear(i));
}

/// Whether the outline leaves the diagonal free that cuts off a corner.
bool EarClipper::is_ear(std::uint32_t i) const {
    if (!is_convex(i)) return false;
    const Double2& a = corners_[previous_[i]];
    const Double2& b = corners_[i];
    const Double2& c = corners_[next_[i]];
    const auto is_at = [](const Double2& p, const Double2& q) { return p.x == q.x && p.y == q.y; };
    for (std::uint32_t j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
        const Double2& p = corners_[j];
        // Outlines around holes run through the same points twice.
        if (is_at(p, a) || is_at(p, b) || is_at(p, c)) continue;
        if (signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 && signed_area(c, a, p) >= 0) return false;
    }
    return true;
}

/// Outlines that intersect themselves may have none: then any corner does.
std::uint32_t EarClipper::find_ear(std::uint32_t begin) const {
    std::uint32_t i = begin;
    do {
        if (is_ear_[i]) return i;
        i = next_[i];
    } while (i != begin);
    return begin;
}

std::vector<Triangle> EarClipper::run() {
    std::vector<Triangle> triangles;
    std::uint32_t position = 0;
    while (triangles.size() + 2 < corners_.size()) {
        const std::uint32_t ear = find_ear(position);
        const std::uint32_t before = previous_[ear];
        const std::uint32_t after = next_[ear];
        triangles.push_back({{before, ear, after}});
        next_[before] = after;
        previous_[after] = before;
        is_ear_[before] = is_ear(before);
        is_ear_[after] = is_ear(after);
        position = after;
    }
    return triangles;
}

bool is_convex(const std::vector<Double2>& corners) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i)
        if (!(signed_area(corners[i], corners[(i + 1) % n], corners[(i + 2) % n]) > 0)) return false;
    // Stars turn left everywhere, too, but seen from the first corner the others do not follow within half a turn.
    for (std::size_t i = 1; i + 1 < n; ++i)
        if (!(signed_area(corners[0], corners[i], corners[i + 1]) > 0 &&
              signed_area(corners[0], corners[1], corners[i + 1]) > 0))
            return false;
    return true;
}

} // namespace

std::vector<Triangle> triangulate_polygon(const std::vector<Double3>& corners) {
    const std::vector<Double2> outline = project(corners);
    const bool has_area = length(area_vector(corners)) > 0;
    if (corners.size() > 3 && has_area && !is_convex(outline)) {
        if (corners.size() > kMaxConcaveCorners)
            throw std::runtime_error("a face of " + std::to_string(corners.size()) +
                                     " corners is not convex; split non-convex faces of more than " +
                                     std::to_string(kMaxConcaveCorners) + " corners into triangles");
        return EarClipper(outline).run();
    }
    std::vector<Triangle> fan;
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) fan.push_back({{0, i, i + 1}});
    return fan;
}

} // namespace nusselt::scene
