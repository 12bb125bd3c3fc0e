#include "scene/model/transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nusselt::scene {

namespace {

Double3 column(const Transform& t, std::size_t j) { return {t.m[0][j], t.m[1][j], t.m[2][j]}; }

} // namespace

Transform operator*(const Transform& a, const Transform& b) {
    Transform result;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            result.m[i][j] = 0;
            for (std::size_t k = 0; k < 4; ++k) result.m[i][j] += a.m[i][k] * b.m[k][j];
        }
    }
    return result;
}

Transform translation(const Double3& offset) {
    Transform t;
    t.m[0][3] = offset.x;
    t.m[1][3] = offset.y;
    t.m[2][3] = offset.z;
    return t;
}

Transform scaling(const Double3& factors) {
    Transform t;
    t.m[0][0] = factors.x;
    t.m[1][1] = factors.y;
    t.m[2][2] = factors.z;
    return t;
}

Transform rotation(double degrees, const Double3& axis) {
    const double angle = degrees * (std::numbers::pi / 180);
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    const Double3 a = (1 / length(axis)) * axis;
    Transform t;
    t.m[0] = {a.x * a.x * (1 - c) + c, a.x * a.y * (1 - c) - a.z * s, a.x * a.z * (1 - c) + a.y * s, 0};
    t.m[1] = {a.y * a.x * (1 - c) + a.z * s, a.y * a.y * (1 - c) + c, a.y * a.z * (1 - c) - a.x * s, 0};
    t.m[2] = {a.z * a.x * (1 - c) - a.y * s, a.z * a.y * (1 - c) + a.x * s, a.z * a.z * (1 - c) + c, 0};
    return t;
}

std::optional<Transform> look_at(const Double3& eye, const Double3& target, const Double3& up) {
    const Double3 forward = normalized(target - eye);
    const Double3 right = normalized(cross(normalized(up), forward));
    const Double3 true_up = cross(forward, right);
    Transform world_from_camera;
    for (const auto& [j, axis] :
         {std::pair<std::size_t, Double3>{0, right}, {1, true_up}, {2, forward}, {3, eye}}) {
        world_from_camera.m[0][j] = axis.x;
        world_from_camera.m[1][j] = axis.y;
        world_from_camera.m[2][j] = axis.z;
    }
    return inverse(world_from_camera);
}

Transform from_columns(const std::array<double, 16>& entries) {
    Transform t;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) t.m[i][j] = entries[4 * j + i];
    return t;
}

std::optional<Transform> inverse(const Transform& t) {
    // Gauss-Jordan elimination with row pivoting.
    Transform a = t;
    Transform result;
    for (std::size_t col = 0; col < 4; ++col) {
        std::size_t pivot = col;
        for (std::size_t row = col + 1; row < 4; ++row)
            if (std::fabs(a.m[row][col]) > std::fabs(a.m[pivot][col])) pivot = row;
        const double divisor = a.m[pivot][col];
        if (!(std::fabs(divisor) > 0) || !std::isfinite(divisor)) return std::nullopt;
        std::swap(a.m[col], a.m[pivot]);
        std::swap(result.m[col], result.m[pivot]);
        for (std::size_t j = 0; j < 4; ++j) {
            a.m[col][j] /= divisor;
            result.m[col][j] /= divisor;
        }
        for (std::size_t row = 0; row < 4; ++row) {
            if (row == col) continue;
            const double factor = a.m[row][col];
            for (std::size_t j = 0; j < 4; ++j) {
                a.m[row][j] -= factor * a.m[col][j];
                result.m[row][j] -= factor * result.m[col][j];
            }
        }
    }
    for (const auto& row : result.m)
        if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); }))
            return std::nullopt;
    return result;
}

double linear_determinant(const Transform& t) { return dot(column(t, 0), cross(column(t, 1), column(t, 2))); }

Double3 transform_point(const Transform& t, const Double3& p) {
    const auto row = [&](std::size_t i) {
        return t.m[i][0] * p.x + t.m[i][1] * p.y + t.m[i][2] * p.z + t.m[i][3];
    };
    const double w = row(3);
    const Double3 result = {row(0), row(1), row(2)};
    return w == 1 ? result : (1 / w) * result;
}

Double3 transform_vector(const Transform& t, const Double3& v) {
    return v.x * column(t, 0) + v.y * column(t, 1) + v.z * column(t, 2);
}

Double3 transform_normal(const Transform& t, const Double3& n) {
    // The cofactor matrix is the inverse transpose times the determinant; it exists for singular matrices
    // too.
    const Double3 a = cross(column(t, 1), column(t, 2));
    const Double3 b = cross(column(t, 2), column(t, 0));
    const Double3 c = cross(column(t, 0), column(t, 1));
    const double largest = std::max({length(a), length(b), length(c)});
    if (!(largest > 0)) return {};
    return (std::copysign(1.0, linear_determinant(t)) / largest) * (n.x * a + n.y * b + n.z * c);
}

bool is_identity(const Transform& t) { return t.m == Transform{}.m; }

bool is_affine(const Transform& t) {
    constexpr double kTolerance = 1e-9;
    for (std::size_t j = 0; j < 3; ++j) {
        const double scale = std::max({std::fabs(t.m[0][j]), std::fabs(t.m[1][j]), std::fabs(t.m[2][j])});
        if (!(std::fabs(t.m[3][j]) <= kTolerance * scale)) return false;
    }
    return std::fabs(t.m[3][3] - 1) <= kTolerance;
}

} // namespace nusselt::scene
