#include "scene/model/polygon.h"

#include "scene/input/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nusselt::scene {

namespace {

double largest_coordinate(const std::vector<Double3>& vertices) {
    double result = 0;
    for (const Double3& v : vertices)
        result = std::max({result, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    return result;
}

double extent(const std::vector<Double3>& vertices) {
    double result = 0;
    for (const Double3& v : vertices) result = std::max(result, length(v - vertices[0]));
    return result;
}

/// The plane that fits a polygon: through its centroid, orthogonal to its area vector.
class Plane {
public:
    explicit Plane(const std::vector<Double3>& vertices) : normal_(normalized(area_vector(vertices))) {
        for (const Double3& v : vertices) center_ = center_ + (1 / static_cast<double>(vertices.size())) * v;
    }
    double distance(const Double3& p) const { return std::fabs(dot(p - center_, normal_)); }
    double largest_distance(const std::vector<Double3>& points) const {
        double result = 0;
        for (const Double3& p : points) result = std::max(result, distance(p));
        return result;
    }

private:
    Double3 normal_;
    Double3 center_;
};

std::vector<Double3> without(std::vector<Double3> vertices, std::size_t i) {
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(i));
    return vertices;
}

/// The vertex without which the others are closest to one plane; among equals, as in a quad, the last one.
std::size_t odd_vertex_out(const std::vector<Double3>& vertices, double tolerance) {
    std::size_t odd = vertices.size() - 1;
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = vertices.size(); i-- > 0;) {
        const std::vector<Double3> others = without(vertices, i);
        const double deviation = Plane(others).largest_distance(others);
        if (deviation >= least - tolerance) continue;
        odd = i;
        least = deviation;
    }
    return odd;
}

} // namespace

Double3 area_vector(const std::vector<Double3>& vertices) {
    Double3 sum;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
        sum = sum + cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
    return sum;
}

std::optional<std::string> find_polygon_defect(const std::vector<Double3>& vertices) {
    const std::size_t n = vertices.size();
    if (n < 3 || n > kMaxPolygonVertices)
        return "it must have 3 to " + std::to_string(kMaxPolygonVertices) + " vertices, found " +
               std::to_string(n);
    const double tolerance = 1e-5 * extent(vertices) + 1e-6 * largest_coordinate(vertices);
    for (std::size_t i = 0; i < n; ++i)
        if (length(vertices[(i + 1) % n] - vertices[i]) <= tolerance)
            return "vertices " + std::to_string(i) + " and " + std::to_string((i + 1) % n) + " coincide";
    const Double3 normal = normalized(area_vector(vertices));
    if (length(normal) == 0) return "its area is zero";

    if (Plane(vertices).largest_distance(vertices) > tolerance) {
        const std::size_t odd = odd_vertex_out(vertices, tolerance);
        const double distance = Plane(without(vertices, odd)).distance(vertices[odd]);
        return "vertex " + std::to_string(odd) + " is " + to_text(distance) +
               " m away from the plane of the others";
    }

    // Each vertex must lie on the inner side of each edge; unlike a test of the corners this finds stars too.
    for (std::size_t i = 0; i < n; ++i) {
        const Double3 edge = vertices[(i + 1) % n] - vertices[i];
        const Double3 inwards = normalized(cross(normal, edge));
        for (std::size_t j = 0; j < n; ++j) {
            const double depth = dot(vertices[j] - vertices[i], inwards);
            if (depth < -tolerance)
                return "it is not convex: vertex " + std::to_string(j) + " is " + to_text(-depth) +
                       " m outside the edge from vertex " + std::to_string(i) + " to " +
                       std::to_string((i + 1) % n);
        }
    }
    if (length(area_vector(vertices)) <= tolerance * extent(vertices)) return "its vertices lie on a line";
    return std::nullopt;
}

bool is_straight(const Float3& before, const Float3& corner, const Float3& after) {
    constexpr double kMinTurn = 1e-5; // sine of the angle by which the outline turns
    const Double3 a = to_double(corner) - to_double(before);
    const Double3 b = to_double(after) - to_double(corner);
    return length(cross(a, b)) <= kMinTurn * length(a) * length(b);
}

std::vector<Float3> without_collinear_vertices(const std::vector<Float3>& vertices) {
    std::vector<Float3> result = vertices;
    for (std::size_t i = 0; i < result.size() && result.size() > 3;) {
        const std::size_t n = result.size();
        if (is_straight(result[(i + n - 1) % n], result[i], result[(i + 1) % n])) {
            result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
            // The turn at the previous vertex has changed.
            i = i > 0 ? i - 1 : 0;
        } else {
            ++i;
        }
    }
    return result;
}

} // namespace nusselt::scene
