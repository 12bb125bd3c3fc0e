#include "exact_shadow.h"

#include <algorithm>
#include <cmath>

namespace nusselt::gpu_visibility_test {

namespace {

using Vec = std::array<double, 3>;

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec& a) { return std::sqrt(dot(a, a)); }
double largest(const Vec& a) { return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])}); }

/// Whether a number has a sign, or is within the margin of zero; NaN is.
enum class Sign { negative, none, positive };
Sign sign_of(double x, double margin) {
    if (x > margin) return Sign::positive;
    return x < -margin ? Sign::negative : Sign::none;
}

enum class Answer { no, maybe, yes };

/// Whether signs are all alike.
Answer are_alike(std::array<Sign, 3> signs) {
    const auto has = [&](Sign sign) { return std::find(signs.begin(), signs.end(), sign) != signs.end(); };
    if (has(Sign::negative) && has(Sign::positive)) return Answer::no;
    return has(Sign::none) ? Answer::maybe : Answer::yes;
}

Answer hit(const std::array<Vec, 3>& corner, const Vec& origin, const Vec& direction, const Vec& end,
           double margin) {
    // The line passes all edges on the same side.
    const auto side = [&](std::size_t i) {
        const Vec a = minus(corner[i], origin);
        const Vec b = minus(corner[(i + 1) % 3], origin);
        const double distance = dot(cross(a, b), direction) / length(cross(minus(b, a), direction));
        return sign_of(distance, margin);
    };
    const Answer inside = are_alike({side(0), side(1), side(2)});
    if (inside == Answer::no) return inside;
    // The ends are on different sides of the plane.
    const Vec normal = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    const auto height = [&](const Vec& p) { return dot(minus(p, corner[0]), normal) / length(normal); };
    const Sign begin = sign_of(height(origin), margin);
    const Sign behind = sign_of(height(end), margin);
    if (begin == Sign::none || behind == Sign::none) return Answer::maybe;
    return begin == behind ? Answer::no : inside;
}

} // namespace

ExactShadow exact_shadow(const scene::Scene& scene, const Ray& ray, double margin) {
    const auto widened = [](const std::array<float, 3>& v) { return Vec{v[0], v[1], v[2]}; };
    const Vec origin = widened(ray.origin);
    const Vec direction = widened(ray.direction);
    Vec end = origin;
    for (std::size_t axis = 0; axis < 3; ++axis) end[axis] += double{ray.t_far} * direction[axis];
    ExactShadow shadow;
    for (const scene::Triangle& triangle : scene.triangles) {
        std::array<Vec, 3> corner;
        double size = std::max(largest(origin), largest(end));
        for (std::size_t i = 0; i < 3; ++i) {
            const scene::Float3& p = scene.positions[triangle.vertex[i]];
            corner[i] = {p.x, p.y, p.z};
            size = std::max(size, largest(corner[i]));
        }
        const Answer answer = hit(corner, origin, direction, end, margin * size);
        shadow.hits |= answer == Answer::yes;
        shadow.unsure |= answer == Answer::maybe;
    }
    return shadow;
}

} // namespace nusselt::gpu_visibility_test
