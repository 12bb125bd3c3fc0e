/// The shipped Cornell boxes against quadrature in double precision with a ray tracer of its own: neither
/// Embree nor packets nor any sampling technique takes part in the reference.

#include "common/source_folder.h"
#include "scenes.h"

#include "render/film.h"
#include "scene/import/importers.h"

#include <nusselt/core/vec.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::render_test {
namespace {

using Vec = Vec3<double>;
using Rgb = std::array<double, 3>;

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

/// Whether a ray meets the cylinder around a line light before a distance.
bool meets_tube(const scene::LineLight& light, const Vec& origin, const Vec& direction, double t_max) {
    const Vec begin = to_vec(light.start);
    const Vec extent = to_vec(light.end) - begin;
    const double length = std::sqrt(dot(extent, extent));
    const Vec axis = (1 / length) * extent;
    const auto across = [&](const Vec& v) { return v - dot(v, axis) * axis; };
    const Vec o = across(origin - begin);
    const Vec d = across(direction);
    const double a = dot(d, d);
    const double b = dot(o, d);
    const double discriminant = b * b - a * (dot(o, o) - double(light.radius) * light.radius);
    if (discriminant < 0) return false;
    // The infinite cylinder, then the slab between its caps.
    const double slab_0 = dot(begin - origin, axis) / dot(direction, axis);
    const double slab_1 = slab_0 + length / dot(direction, axis);
    const double enter = std::max((-b - std::sqrt(discriminant)) / a, std::min(slab_0, slab_1));
    const double leave = std::min((-b + std::sqrt(discriminant)) / a, std::max(slab_0, slab_1));
    return enter <= leave && leave > 0 && enter < t_max;
}

/// The reference for a pixel.
struct Pixel {
    bool sees_light = false;
    bool in_penumbra = false; ///< a light is visible in parts
    Rgb radiance{};           ///< reflected
};

/// Midpoint rule over pieces of the lights, with a shadow ray for each.
class Quadrature {
public:
    explicit Quadrature(const scene::Scene& scene) : scene_(scene), tracer_(scene) {}

    /// The centre of a pixel in a matte scene.
    Pixel pixel(int x, int y) const {
        const scene::Camera& camera = scene_.camera;
        const Vec origin = to_vec(camera.origin);
        const Vec direction =
            to_vec(camera.corner) + (x + 0.5) * to_vec(camera.right) + (y + 0.5) * to_vec(camera.down);
        const auto hit = tracer_.closest(origin, direction);
        for (const scene::LineLight& light : scene_.lights.of<scene::LineLight>())
            if (meets_tube(light, origin, direction, hit.t)) return {.sees_light = true};
        if (hit.t == kInfinity) return {};
        if (scene_.triangle_light[hit.triangle] >= 0) return {.sees_light = true};
        const Vec normal = dot(hit.normal, direction) < 0 ? hit.normal : -hit.normal;
        const Vec point = origin + hit.t * direction;
        const Rgb albedo = to_rgb(scene_.materials[scene_.triangle_material[hit.triangle]].diffuse);
        Pixel result;
        for (const scene::LineLight& light : scene_.lights.of<scene::LineLight>())
            add(line_integral(light, point, normal), light.radius, to_rgb(light.radiance), albedo, result);
        for (const scene::PolygonLight& light : scene_.lights.of<scene::PolygonLight>())
            add(panel_integral(light, point, normal), 1, to_rgb(light.radiance), albedo, result);
        return result;
    }

private:
    /// Irradiance over radiance (times radius for lines).
    struct Integral {
        double visible = 0;
        double blocked = 0;
    };

    static void add(const Integral& integral, double factor, const Rgb& emission, const Rgb& albedo,
                    Pixel& pixel) {
        for (std::size_t i = 0; i < 3; ++i)
            pixel.radiance[i] += factor * integral.visible * emission[i] * albedo[i] / std::numbers::pi;
        pixel.in_penumbra |= integral.visible > 0 && integral.blocked > 0;
    }

    Integral line_integral(const scene::LineLight& light, const Vec& point, const Vec& normal) const {
        constexpr int kPieces = 1024;
        const Vec begin = to_vec(light.start);
        const Vec extent = to_vec(light.end) - begin;
        Integral sum;
        for (int i = 0; i < kPieces; ++i) {
            const Vec on_light = begin + ((i + 0.5) / kPieces) * extent;
            const Vec d = on_light - point;
            const double r2 = dot(d, d);
            const double cosine = dot(d, normal) / std::sqrt(r2);
            if (cosine <= 0) continue;
            const Vec n = cross(d, extent);
            double& part = tracer_.is_blocked(point, on_light) ? sum.blocked : sum.visible;
            part += 2 * std::sqrt(dot(n, n) / r2) * cosine / r2 / kPieces;
        }
        return sum;
    }

    /// The integral over a parallelogram.
    Integral panel_integral(const scene::PolygonLight& light, const Vec& point, const Vec& normal) const {
        constexpr int kPieces = 96;
        const Vec corner = to_vec(light.vertices.at(0));
        const Vec e1 = to_vec(light.vertices.at(1)) - corner;
        const Vec e2 = to_vec(light.vertices.at(3)) - corner;
        const Vec area = cross(e1, e2);
        Integral sum;
        for (int i = 0; i < kPieces * kPieces; ++i) {
            const double u = (i % kPieces + 0.5) / kPieces;
            const double v = (i / kPieces + 0.5) / kPieces;
            const Vec on_light = corner + u * e1 + v * e2;
            const Vec d = on_light - point;
            const double r2 = dot(d, d);
            const double cosine = dot(d, normal);
            double facing = -dot(d, area);
            if (light.two_sided) facing = std::fabs(facing);
            if (cosine <= 0 || facing <= 0) continue;
            double& part = tracer_.is_blocked(point, on_light) ? sum.blocked : sum.visible;
            part += cosine * facing / (r2 * r2 * kPieces * kPieces);
        }
        return sum;
    }

    const scene::Scene& scene_;
    BruteForceTracer tracer_;
};

class CornellQuadrature : public testing::Test {
protected:
    /// \param height even: with the width being odd, no ray through a pixel centre meets an edge of the
    /// symmetric
    ///               room
    void load(const char* file, int height) {
        scene_ = scene::load_scene(std::string(nusselt_test::kSourceFolder) + "/scenes/" + file);
        for (scene::LineLight& light : scene_.lights.of<scene::LineLight>())
            light.model = scene::TubeModel::linear;
        render::resize_film(scene_, height + 1, height);
        const Quadrature quadrature(scene_);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < height + 1; ++x) pixels_.push_back(quadrature.pixel(x, y));
    }

    image::Image render(int samples) const {
        render::RenderSettings settings;
        settings.samples = samples;
        settings.pixel_position = render::PixelPosition::center;
        settings.brdf = render::BrdfChoice::lambert;
        return render_cpu::Renderer(scene_, 2).render(settings, base::choose_isa()).image;
    }

    /// RMSE over the chosen pixels, divided by their mean. \param expected of a pixel and channel
    template <class Choose, class Expected>
    double relative_rmse(const image::Image& image, Choose is_chosen, Expected expected) const {
        double squares = 0;
        double sum = 0;
        double count = 0;
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            if (pixels_[i].sees_light || !is_chosen(pixels_[i])) continue;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const double error = image.pixels[3 * i + channel] - expected(i, channel);
                squares += error * error;
                sum += expected(i, channel);
                count += 1;
            }
        }
        EXPECT_GT(count, 3 * 0.6 * static_cast<double>(pixels_.size())) << "too few pixels to tell";
        return std::sqrt(squares / count) / (sum / count);
    }

    double relative_rmse_to_quadrature(const image::Image& image) const {
        return relative_rmse(
            image, [](const Pixel&) { return true; },
            [&](std::size_t i, std::size_t channel) { return pixels_[i].radiance[channel]; });
    }

    scene::Scene scene_;
    std::vector<Pixel> pixels_;
};

TEST_F(CornellQuadrature, BoxWithTube) {
    load("cornell-tube.pbrt", 48);
    EXPECT_LT(relative_rmse_to_quadrature(render(1024)), 0.005);
}

TEST_F(CornellQuadrature, BoxWithPanel) {
    load("cornell-panel.pbrt", 24);
    EXPECT_LT(relative_rmse_to_quadrature(render(1024)), 0.005);
}

/// Fig. 6 of the paper on linear lights: outside penumbrae, a single sample is as good as a thousand.
TEST_F(CornellQuadrature, OneSampleSufficesOutsideOfPenumbrae) {
    load("cornell-tube.pbrt", 96);
    const image::Image reference = render(1024);
    EXPECT_LT(
        relative_rmse(
            render(1), [](const Pixel& pixel) { return !pixel.in_penumbra; },
            [&](std::size_t i, std::size_t channel) { return double(reference.pixels[3 * i + channel]); }),
        1e-4);
}

} // namespace
} // namespace nusselt::render_test
