/// The shipped Cornell boxes against quadrature in double precision with a ray tracer of its own: neither
/// Embree nor packets nor any sampling technique takes part in the reference.

#include "scenes.h"

#include "render_cpu/film.h"
#include "scene/load.h"

#include <nusselt/core/vec.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace nusselt::render_test {
namespace {

using Vec = Vec3<double>;
using Rgb = std::array<double, 3>;

constexpr int kSize = 48;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec to_vec(const Float3& v) { return {v.x, v.y, v.z}; }
Rgb to_rgb(const Float3& v) { return {v.x, v.y, v.z}; }

/// Tests every triangle, one ray at a time.
class BruteForceTracer {
public:
    struct Hit {
        double t = kInfinity;
        std::size_t triangle = 0;
        Vec normal{};
    };

    explicit BruteForceTracer(const scene::Scene& scene) {
        for (const scene::Triangle& triangle : scene.triangles) {
            const Vec a = to_vec(scene.positions[triangle.vertex[0]]);
            corners_.push_back({a, to_vec(scene.positions[triangle.vertex[1]]) - a,
                                to_vec(scene.positions[triangle.vertex[2]]) - a});
        }
    }

    Hit closest(const Vec& origin, const Vec& direction) const {
        Hit hit;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const double t = intersect(corners_[i], origin, direction);
            if (t < hit.t) hit = {t, i, normalize(cross(corners_[i].e1, corners_[i].e2))};
        }
        return hit;
    }

    /// Whether anything lies strictly between two points.
    bool is_blocked(const Vec& from, const Vec& to) const {
        constexpr double kMargin = 1e-6;
        const Vec direction = to - from;
        for (const Corner& corner : corners_) {
            const double t = intersect(corner, from, direction);
            if (t > kMargin && t < 1 - kMargin) return true;
        }
        return false;
    }

private:
    struct Corner {
        Vec p, e1, e2;
    };

    /// The ray parameter, or infinity.
    static double intersect(const Corner& corner, const Vec& origin, const Vec& direction) {
        const Vec p = cross(direction, corner.e2);
        const double determinant = dot(corner.e1, p);
        if (determinant == 0) return kInfinity;
        const Vec offset = origin - corner.p;
        const double u = dot(offset, p) / determinant;
        const Vec q = cross(offset, corner.e1);
        const double v = dot(direction, q) / determinant;
        const double t = dot(corner.e2, q) / determinant;
        return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : kInfinity;
    }

    std::vector<Corner> corners_;
};

/// Whether a ray meets the mantle of the cylinder around a line light before a distance.
bool meets_tube(const scene::LineLight& light, const Vec& origin, const Vec& direction, double t_max) {
    const Vec begin = to_vec(light.begin);
    const Vec extent = to_vec(light.end) - begin;
    const Vec axis = normalize(extent);
    const auto across = [&](const Vec& v) { return v - dot(v, axis) * axis; };
    const Vec o = across(origin - begin);
    const Vec d = across(direction);
    const double b = dot(o, d);
    const double discriminant = b * b - dot(d, d) * (dot(o, o) - double(light.radius) * light.radius);
    if (discriminant < 0) return false;
    const double t = (-b - std::sqrt(discriminant)) / dot(d, d);
    const double along = dot(origin + t * direction - begin, axis);
    return t > 0 && t < t_max && along >= 0 && along <= std::sqrt(dot(extent, extent));
}

/// Irradiance over radiance: midpoint rule over pieces of the lights, with a shadow ray for each.
class Quadrature {
public:
    explicit Quadrature(const scene::Scene& scene) : scene_(scene), tracer_(scene) {}

    /// Reflected radiance of a matte scene at the centre of a pixel; nothing if it sees a light.
    std::optional<Rgb> radiance(int x, int y) const {
        const scene::Camera& camera = scene_.camera;
        const Vec origin = to_vec(camera.origin);
        const Vec direction =
            to_vec(camera.corner) + (x + 0.5) * to_vec(camera.right) + (y + 0.5) * to_vec(camera.down);
        const auto hit = tracer_.closest(origin, direction);
        for (const scene::LineLight& light : scene_.line_lights)
            if (meets_tube(light, origin, direction, hit.t)) return {};
        if (hit.t == kInfinity) return Rgb{};
        if (scene_.triangle_light[hit.triangle] >= 0) return {};
        const Vec normal = dot(hit.normal, direction) < 0 ? hit.normal : -hit.normal;
        const Vec point = origin + hit.t * direction;
        const Rgb albedo = to_rgb(scene_.materials[scene_.triangle_material[hit.triangle]].diffuse);
        Rgb result{};
        for (const scene::LineLight& light : scene_.line_lights)
            add(line_integral(light, point, normal) * light.radius, to_rgb(light.radiance), albedo, result);
        for (const scene::PolygonLight& light : scene_.polygon_lights)
            add(panel_integral(light, point, normal), to_rgb(light.radiance), albedo, result);
        return result;
    }

private:
    static void add(double integral, const Rgb& emission, const Rgb& albedo, Rgb& sum) {
        for (std::size_t i = 0; i < 3; ++i) sum[i] += integral * emission[i] * albedo[i] / std::numbers::pi;
    }

    double line_integral(const scene::LineLight& light, const Vec& point, const Vec& normal) const {
        constexpr int kPieces = 1024;
        const Vec begin = to_vec(light.begin);
        const Vec extent = to_vec(light.end) - begin;
        double sum = 0;
        for (int i = 0; i < kPieces; ++i) {
            const Vec on_light = begin + ((i + 0.5) / kPieces) * extent;
            const Vec d = on_light - point;
            const double r2 = dot(d, d);
            const double cosine = dot(d, normal) / std::sqrt(r2);
            if (cosine <= 0 || tracer_.is_blocked(point, on_light)) continue;
            const Vec n = cross(d, extent);
            sum += 2 * std::sqrt(dot(n, n) / r2) * cosine / r2 / kPieces;
        }
        return sum;
    }

    /// Of a parallelogram.
    double panel_integral(const scene::PolygonLight& light, const Vec& point, const Vec& normal) const {
        constexpr int kPieces = 96;
        const Vec corner = to_vec(light.vertices.at(0));
        const Vec e1 = to_vec(light.vertices.at(1)) - corner;
        const Vec e2 = to_vec(light.vertices.at(3)) - corner;
        const Vec area = cross(e1, e2);
        double sum = 0;
        for (int i = 0; i < kPieces * kPieces; ++i) {
            const double u = (i % kPieces + 0.5) / kPieces;
            const double v = (i / kPieces + 0.5) / kPieces;
            const Vec on_light = corner + u * e1 + v * e2;
            const Vec d = on_light - point;
            const double r2 = dot(d, d);
            const double cosine = dot(d, normal);
            double facing = -dot(d, area);
            if (light.two_sided) facing = std::fabs(facing);
            if (cosine <= 0 || facing <= 0 || tracer_.is_blocked(point, on_light)) continue;
            sum += cosine * facing / (r2 * r2);
        }
        return sum / (kPieces * kPieces);
    }

    const scene::Scene& scene_;
    BruteForceTracer tracer_;
};

struct Difference {
    double relative_rmse = 0;
    int compared_pixels = 0;
};

Difference difference_to_quadrature(const char* file, int size) {
    scene::Scene scene = scene::load_scene(std::string(NUSSELT_SOURCE_DIR "/scenes/") + file);
    render_cpu::resize_film(scene, size, size);
    render_cpu::RenderSettings settings;
    settings.samples = 1024;
    settings.pixel_position = render_cpu::PixelPosition::center;
    settings.brdf = render_cpu::BrdfChoice::lambert;
    const image::Image image =
        render_cpu::Renderer(scene, 2).render(settings, render_cpu::choose_isa()).image;

    const Quadrature quadrature(scene);
    double squares = 0;
    double sum = 0;
    Difference result;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto expected = quadrature.radiance(x, y);
            if (!expected) continue;
            ++result.compared_pixels;
            for (std::size_t i = 0; i < 3; ++i) {
                const double value = image.pixels[3 * static_cast<std::size_t>(y * size + x) + i];
                squares += (value - (*expected)[i]) * (value - (*expected)[i]);
                sum += (*expected)[i];
            }
        }
    const double count = 3 * result.compared_pixels;
    result.relative_rmse = std::sqrt(squares / count) / (sum / count);
    return result;
}

TEST(CornellQuadrature, BoxWithTube) {
    const Difference difference = difference_to_quadrature("cornell-tube.pbrt", kSize);
    EXPECT_GT(difference.compared_pixels, kSize * kSize * 9 / 10);
    EXPECT_LT(difference.relative_rmse, 0.005);
}

TEST(CornellQuadrature, BoxWithPanel) {
    const Difference difference = difference_to_quadrature("cornell-panel.pbrt", kSize / 2);
    EXPECT_GT(difference.compared_pixels, kSize * kSize / 4 * 8 / 10);
    EXPECT_LT(difference.relative_rmse, 0.005);
}

} // namespace
} // namespace nusselt::render_test
