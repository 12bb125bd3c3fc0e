#include "scene/build/lights/camera_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace nusselt::scene {

namespace {

/// Half a second on one core.
constexpr std::uint64_t kMostTests = 100'000'000;
/// Points of the film in each direction.
constexpr int kSide = 16;
/// Triangles that rays meet one after the other before those that met something are dropped.
constexpr std::size_t kTogether = 256;

using Corners = std::array<Double3, 3>;

bool is_whole(const Material& material) { return material.alpha >= 1 && material.alpha_texture.texture < 0; }

Corners corners_of(const Scene& scene, std::size_t triangle) {
    const auto& [i, j, k] = scene.triangles[triangle].vertex;
    return {to_double(scene.positions[i]), to_double(scene.positions[j]), to_double(scene.positions[k])};
}

Double3 to_world(const Instance& instance, const Double3& p) {
    const std::array<float, 12>& m = instance.world_from_object;
    const auto row = [&](std::size_t i) { return m[i] * p.x + m[i + 1] * p.y + m[i + 2] * p.z + m[i + 3]; };
    return {row(0), row(4), row(8)};
}

/// Passes a function the corners of all triangles in world space, kTogether at a time, until it returns false.
template <class Take>
void for_each_triangle(const Scene& scene, const Take& take) {
    std::vector<Corners> together;
    const auto add = [&](std::size_t triangle, const Instance* instance) {
        if (!is_whole(scene.materials[scene.triangle_material[triangle]])) return true;
        Corners corners = corners_of(scene, triangle);
        if (instance != nullptr)
            for (Double3& corner : corners) corner = to_world(*instance, corner);
        together.push_back(corners);
        if (together.size() < kTogether) return true;
        const bool goes_on = take(together);
        together.clear();
        return goes_on;
    };
    for (std::size_t i = 0; i < world_triangle_count(scene); ++i)
        if (!add(i, nullptr)) return;
    for (const Instance& instance : scene.instances) {
        const Object& object = scene.objects[instance.object];
        for (std::uint32_t i = 0; i < object.triangle_count; ++i)
            if (!add(object.first_triangle + i, &instance)) return;
    }
    take(together);
}

std::uint64_t triangle_count(const Scene& scene) {
    std::uint64_t count = world_triangle_count(scene);
    for (const Instance& instance : scene.instances) count += scene.objects[instance.object].triangle_count;
    return count;
}

/// Where a ray meets a triangle, in multiples of its direction (Moeller and Trumbore 1997); nothing if it misses.
std::optional<double> hit(const Double3& origin, const Double3& direction, const Corners& corners) {
    const Double3 first = corners[1] - corners[0];
    const Double3 second = corners[2] - corners[0];
    const Double3 p = cross(direction, second);
    const double determinant = dot(first, p);
    if (determinant == 0) return std::nullopt;
    const double inverse = 1 / determinant;
    const Double3 from_corner = origin - corners[0];
    const double u = inverse * dot(from_corner, p);
    if (!(u >= 0 && u <= 1)) return std::nullopt;
    const Double3 q = cross(from_corner, first);
    const double v = inverse * dot(direction, q);
    if (!(v >= 0 && u + v <= 1)) return std::nullopt;
    const double t = inverse * dot(second, q);
    return t > 0 ? std::optional(t) : std::nullopt;
}

/// The fractional part of multiples of an irrational number: evenly spread.
double spread(std::uint32_t index, double ratio) {
    const double multiple = (index + 0.5) * ratio;
    return multiple - std::floor(multiple);
}

} // namespace

CameraView::CameraView(const Scene& scene) : scene_(scene) {
    tests_ = triangle_count(scene) * kSide * kSide;
    is_known_ = tests_ <= kMostTests;
    if (is_known_) see(scene.camera, scene.film);
}

void CameraView::see(const Camera& camera, const Film& film) {
    struct Seen {
        Ray ray;
        double distance = std::numeric_limits<double>::infinity(); ///< in multiples of the direction
        Double3 normal = {};
    };
    std::vector<Seen> seen;
    for (int i = 0; i < kSide * kSide; ++i) {
        const double x = (i % kSide + 0.5) / kSide * film.width;
        const double y = (i / kSide + 0.5) / kSide * film.height;
        seen.push_back(
            {{to_double(camera.origin) + x * to_double(camera.origin_right) +
                  y * to_double(camera.origin_down),
              to_double(camera.corner) + x * to_double(camera.right) + y * to_double(camera.down)}});
    }
    for_each_triangle(scene_, [&](const std::vector<Corners>& triangles) {
        for (Seen& one : seen) {
            for (const Corners& corners : triangles) {
                const std::optional<double> t = hit(one.ray.origin, one.ray.direction, corners);
                if (!t || *t >= one.distance) continue;
                one.distance = *t;
                one.normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
            }
        }
        return true;
    });
    const double above = 1e-5 * scene_.radius;
    for (const Seen& one : seen) {
        if (!std::isfinite(one.distance)) {
            sky_rays_.push_back(one.ray);
            continue;
        }
        const double side = dot(one.normal, one.ray.direction) < 0 ? 1 : -1;
        const Double3 normal = side * one.normal;
        points_.push_back({one.ray.origin + one.distance * one.ray.direction + above * normal, normal});
    }
}

bool CameraView::passes(const Ray& ray, const PolygonVertices& portal) {
    for (std::size_t k = 2; k < portal.size(); ++k)
        if (hit(ray.origin, ray.direction,
                {to_double(portal[0]), to_double(portal[k - 1]), to_double(portal[k])}))
            return true;
    return false;
}

Double3 CameraView::point_of(const PolygonVertices& portal) {
    // Multiples of powers of the plastic number cover a square evenly. Each triangle of a fan gets as many points.
    const std::uint32_t index = portal_points_++;
    const double along = std::sqrt(spread(index, 0.7548776662466927));
    const double across = spread(index, 0.5698402909980532);
    const auto triangles = static_cast<std::uint32_t>(portal.size()) - 2;
    const std::size_t k = 2 + index % triangles;
    const Double3 corner = to_double(portal[0]);
    return corner + along * ((1 - across) * (to_double(portal[k - 1]) - corner) +
                             across * (to_double(portal[k]) - corner));
}

bool CameraView::reaches_sky(std::vector<Ray> rays) {
    if (tests_ > kMostTests) return true;
    for_each_triangle(scene_, [&](const std::vector<Corners>& triangles) {
        tests_ += rays.size() * triangles.size();
        std::erase_if(rays, [&](const Ray& ray) {
            return std::any_of(triangles.begin(), triangles.end(), [&](const Corners& corners) {
                return hit(ray.origin, ray.direction, corners).has_value();
            });
        });
        return !rays.empty();
    });
    return !rays.empty();
}

} // namespace nusselt::scene
