#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace nusselt::render_test {

namespace {

Float3 minus(const Float3& a, const Float3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Float3 times(double s, const Float3& a) {
    return {static_cast<float>(s * a.x), static_cast<float>(s * a.y), static_cast<float>(s * a.z)};
}
Float3 plus(const Float3& a, const Float3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Float3 cross(const Float3& a, const Float3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Float3 unit(const Float3& a) { return times(1 / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z), a); }

/// An upright box on the floor.
void add_box(scene::Scene& scene, const Float3& low, const Float3& high, int material) {
    const auto corner = [&](int i) {
        return Float3{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    };
    for (const std::array<int, 4>& face :
         {std::array{0, 1, 5, 4}, std::array{1, 3, 7, 5}, std::array{3, 2, 6, 7}, std::array{2, 0, 4, 6},
          std::array{4, 5, 7, 6}})
        add_quad(scene, {corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])}, material);
}

struct Moments {
    double mean = 0;
    double squared_error = 0; ///< of the mean
};

Moments moments(const std::vector<double>& values) {
    Moments result;
    const auto count = static_cast<double>(values.size());
    for (const double value : values) result.mean += value / count;
    for (const double value : values)
        result.squared_error += (value - result.mean) * (value - result.mean) / (count * (count - 1));
    return result;
}

/// Rounding of float images, relative: means closer than this do not differ.
constexpr double kRounding = 2e-6;

double t_of(double difference, double squared_error, double magnitude) {
    const double excess = std::max(0.0, std::fabs(difference) - kRounding * std::fabs(magnitude));
    if (excess == 0) return 0;
    return excess / std::sqrt(squared_error);
}

std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t index) {
    std::vector<double> result;
    for (const auto& row : rows) result.push_back(row[index]);
    return result;
}

} // namespace

void add_quad(scene::Scene& scene, const std::array<Float3, 4>& corners, int material, int light) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const Float3& corner : corners) {
        scene.positions.push_back(corner);
        scene.normals.push_back({0, 0, 0});
        scene.uvs.push_back({0, 0});
    }
    for (const scene::Triangle& triangle :
         {scene::Triangle{{first, first + 1, first + 2}}, scene::Triangle{{first, first + 2, first + 3}}}) {
        scene.triangles.push_back(triangle);
        scene.triangle_material.push_back(static_cast<std::uint32_t>(material));
        scene.triangle_light.push_back(light);
    }
}

void add_polygon_light(scene::Scene& scene, const std::array<Float3, 4>& corners, const Float3& radiance,
                       bool two_sided, int material) {
    scene::PolygonLight light;
    light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"panel"});
    light.vertices.assign(corners.begin(), corners.end());
    light.radiance = radiance;
    light.two_sided = two_sided;
    const int index = static_cast<int>(scene.lights.of<scene::PolygonLight>().size());
    scene.lights.of<scene::PolygonLight>().push_back(light);
    add_quad(scene, corners, material, index);
}

void add_line_light(scene::Scene& scene, const char* name, scene::LineLight light) {
    light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({name});
    scene.lights.of<scene::LineLight>().push_back(light);
}

void set_camera(scene::Scene& scene, const Float3& eye, const Float3& target, const Float3& up,
                double tangent, int width, int height) {
    const Float3 forward = unit(minus(target, eye));
    const Float3 right = unit(cross(forward, up));
    const Float3 down = cross(forward, right);
    const double pixel = 2 * tangent / height;
    scene.camera.origin = eye;
    scene.camera.right = times(pixel, right);
    scene.camera.down = times(pixel, down);
    scene.camera.corner =
        plus(forward, plus(times(-0.5 * width, scene.camera.right), times(-0.5 * height, scene.camera.down)));
    scene.film.width = width;
    scene.film.height = height;
}

void set_radius(scene::Scene& scene) {
    Float3 low = scene.positions.at(0);
    Float3 high = low;
    const auto include = [&](const Float3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    };
    for (const Float3& p : scene.positions) include(p);
    for (const scene::LineLight& light : scene.lights.of<scene::LineLight>()) {
        include(light.start);
        include(light.end);
    }
    const Float3 diagonal = minus(high, low);
    scene.radius =
        0.5 * std::sqrt(diagonal.x * diagonal.x + diagonal.y * diagonal.y + diagonal.z * diagonal.z);
}

scene::Scene scaled(scene::Scene scene, float factor) {
    for (Float3& p : scene.positions) p = times(factor, p);
    for (scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>())
        for (Float3& p : light.vertices) p = times(factor, p);
    for (scene::LineLight& light : scene.lights.of<scene::LineLight>()) {
        light.start = times(factor, light.start);
        light.end = times(factor, light.end);
        light.radius *= factor;
    }
    scene.camera.origin = times(factor, scene.camera.origin);
    scene.radius *= factor;
    return scene;
}

scene::Scene make_floor(int size) {
    scene::Scene scene;
    scene.materials.push_back({.name = "floor", .diffuse = {kFloorAlbedo, kFloorAlbedo, kFloorAlbedo}});
    add_quad(scene, {Float3{-4, -4, 0}, Float3{4, -4, 0}, Float3{4, 4, 0}, Float3{-4, 4, 0}}, 0);
    set_camera(scene, {0.1f, -2.5f, 0.7f}, {0.1f, 0, 0}, {0, 0, 1}, 0.3, size, size);
    set_radius(scene);
    return scene;
}

scene::Scene make_box_scene(int size) {
    scene::Scene scene;
    scene.materials.push_back({.name = "matte", .diffuse = {0.7f, 0.6f, 0.5f}});
    scene.materials.push_back({.name = "glossy",
                               .model = scene::BrdfModel::frostbite,
                               .diffuse = {0.3f, 0.3f, 0.5f},
                               .f0 = {0.1f, 0.1f, 0.1f},
                               .roughness = 0.6f});
    add_quad(scene, {Float3{-1, -1, 0}, Float3{1, -1, 0}, Float3{1, 1, 0}, Float3{-1, 1, 0}}, 1);
    add_quad(scene, {Float3{-1, 1, 0}, Float3{1, 1, 0}, Float3{1, 1, 2}, Float3{-1, 1, 2}}, 0);
    add_quad(scene, {Float3{-1, -1, 0}, Float3{-1, 1, 0}, Float3{-1, 1, 2}, Float3{-1, -1, 2}}, 0);
    add_quad(scene, {Float3{1, 1, 0}, Float3{1, -1, 0}, Float3{1, -1, 2}, Float3{1, 1, 2}}, 0);
    add_quad(scene, {Float3{-1, 1, 2}, Float3{1, 1, 2}, Float3{1, -1, 2}, Float3{-1, -1, 2}}, 0);
    add_box(scene, {-0.6f, -0.1f, 0}, {-0.1f, 0.4f, 1.1f}, 0);
    add_box(scene, {0.2f, -0.6f, 0}, {0.7f, -0.1f, 0.5f}, 1);
    add_polygon_light(scene,
                      {Float3{-0.4f, -0.3f, 1.9f}, Float3{-0.4f, 0.3f, 1.9f}, Float3{0.3f, 0.3f, 1.8f},
                       Float3{0.3f, -0.3f, 1.8f}},
                      {6, 6, 5}, false, 0);
    add_line_light(
        scene, "tube",
        {0, {0.9f, -0.8f, 1.5f}, {0.8f, 0.9f, 1.2f}, 0.01f, {60, 60, 80}, scene::TubeModel::linear});
    add_line_light(scene, "pipe",
                   {0, {-0.6f, -0.7f, 1.1f}, {-0.8f, 0.3f, 1.6f}, 0.07f, {3, 8, 3}, scene::TubeModel::solid});
    set_camera(scene, {0, -4, 1}, {0, 0, 1}, {0, 0, 1}, 0.32, size, size);
    set_radius(scene);
    return scene;
}

std::vector<double> region_means(const image::Image& image, int regions_per_axis) {
    const auto n = static_cast<std::size_t>(regions_per_axis);
    std::vector<double> sums(n * n);
    std::vector<double> counts(n * n);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto row = static_cast<std::size_t>(y * regions_per_axis / image.height);
            const auto region = row * n + static_cast<std::size_t>(x * regions_per_axis / image.width);
            const std::size_t pixel = 3 * static_cast<std::size_t>(y * image.width + x);
            for (std::size_t channel = 0; channel < 3; ++channel)
                sums[region] += image.pixels[pixel + channel];
            counts[region] += 3;
        }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
    return sums;
}

std::vector<std::vector<double>> render_region_means(const render_cpu::Renderer& renderer,
                                                     render::RenderSettings settings, int seed_count,
                                                     const visibility::RayTracer& tracer) {
    std::vector<std::vector<double>> rows;
    for (int seed = 0; seed < seed_count; ++seed) {
        // Techniques that are compared must not share random numbers.
        settings.seed = static_cast<std::uint32_t>(1000 * static_cast<int>(settings.technique) + seed);
        const auto result = renderer.render(settings, base::choose_isa(), tracer);
        rows.push_back(region_means(result.image, kRegionsPerAxis));
    }
    return rows;
}

double t_statistic(const std::vector<double>& values, double mean) {
    const Moments m = moments(values);
    return t_of(m.mean - mean, m.squared_error, mean);
}

double t_statistic(const std::vector<double>& a, const std::vector<double>& b) {
    const Moments ma = moments(a);
    const Moments mb = moments(b);
    return t_of(ma.mean - mb.mean, ma.squared_error + mb.squared_error, mb.mean);
}

double largest_t(const std::vector<std::vector<double>>& rows, const std::vector<double>& expected) {
    double largest = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        largest = std::max(largest, t_statistic(column(rows, i), expected[i]));
    return largest;
}

double largest_t(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.at(0).size(); ++i)
        largest = std::max(largest, t_statistic(column(a, i), column(b, i)));
    return largest;
}

} // namespace nusselt::render_test
