// A complete path tracer for Lambertian surfaces, lit by a panel and a tube. docs/porting.md walks through the places
// where it meets the library. It needs nothing else:
//   g++ -std=c++17 -O2 -I include examples/path_tracer/path_tracer.cpp -o path_tracer && ./path_tracer room.ppm

#include <nusselt/nusselt.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

using Vec = nusselt::Vec3<float>;
using nusselt::Frame;

constexpr float kNowhere = std::numeric_limits<float>::infinity();
constexpr float kOffset = 1e-4f; // of shadow rays from surfaces [m]
constexpr Vec kEye{0, 1.3f, 2.5f};

/// Product per colour channel.
Vec tint(const Vec& a, const Vec& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

struct Rectangle {
    Vec corner, a, b; ///< orthogonal sides [m]
    Vec albedo;
};
struct Sphere {
    Vec centre;
    float radius; ///< [m]
    Vec albedo;
};
/// Emits on the side that its normal points to.
struct Panel {
    nusselt::ConvexPolygon<float, 4> shape;
    Vec radiance; ///< [W/(sr m^2)]
};
struct Tube {
    nusselt::LineSegment<float> shape;
    float radius; ///< [m]
    Vec radiance; ///< [W/(sr m^2)]
};
struct Hit {
    float distance; ///< kNowhere if there is none
    Vec normal;     ///< unit, outwards for spheres
    Vec albedo;
};

struct Scene {
    std::vector<Rectangle> rectangles;
    std::vector<Sphere> spheres;
    Panel panel;
    Tube tube;

    /// The closest surface along a ray with a unit direction.
    Hit closest(const Vec& origin, const Vec& direction) const {
        Hit hit{kNowhere, {}, {}};
        for (const Rectangle& r : rectangles) {
            const Vec n = nusselt::normalize(cross(r.a, r.b));
            const float t = dot(r.corner - origin, n) / dot(direction, n);
            if (!(t > 0) || t >= hit.distance) continue;
            const Vec p = origin + t * direction - r.corner;
            const float u = dot(p, r.a) / dot(r.a, r.a);
            const float v = dot(p, r.b) / dot(r.b, r.b);
            if (u >= 0 && u <= 1 && v >= 0 && v <= 1) hit = {t, n, r.albedo};
        }
        for (const Sphere& s : spheres) {
            const Vec to_centre = s.centre - origin;
            const float along = dot(to_centre, direction);
            const Vec miss = to_centre - along * direction;
            const float under_root = s.radius * s.radius - dot(miss, miss);
            if (under_root < 0) continue;
            const float root = std::sqrt(under_root);
            const float t = along - root > 0 ? along - root : along + root;
            if (t > 0 && t < hit.distance)
                hit = {t, (1 / s.radius) * (origin + t * direction - s.centre), s.albedo};
        }
        return hit;
    }

    /// Whether nothing lies between a point on a surface and a point on a light. The light itself does not count.
    bool visible(const Vec& from, const Vec& normal, const Vec& to) const {
        const Vec origin = from + kOffset * normal;
        const float distance = length(to - origin);
        return closest(origin, normalize(to - origin)).distance >= distance - kOffset;
    }
};

/// Random numbers in [0, 1).
class Random {
public:
    explicit Random(std::uint32_t seed) : bits_(seed) {}
    float next() { return nusselt::to_unit(bits_()); }

private:
    nusselt::Pcg32 bits_;
};

/// Light of the panel that a white surface reflects.
/// \param point on the surface; the z axis of the frame is its normal on the side of the viewer.
Vec light_of_panel(const Scene& scene, const Vec& point, const Frame<float>& frame, Random& random) {
    const auto light = to_shading_space(scene.panel.shape, point, frame);
    if (plane_distance(light) >= 0) return {}; // the point is behind the panel
    const nusselt::PolygonProjectedSolidAngle<float, 4> technique(light);
    const float u = random.next();
    const auto sample = technique.sample({u, random.next()});
    if (sample.pdf == 0) return {}; // below the horizon, or edge-on
    if (!scene.visible(point, frame.n, point + frame.to_world(sample.p))) return {};
    const float brdf = 1 / nusselt::kPi<float>;
    return (brdf * sample.wi.z / sample.pdf) * scene.panel.radiance;
}

/// Light of the tube that a white surface reflects.
Vec light_of_tube(const Scene& scene, const Vec& point, const Frame<float>& frame, Random& random) {
    const nusselt::LineProjectedSolidAngle<float> technique(to_shading_space(scene.tube.shape, point, frame));
    const auto sample = technique.sample(random.next());
    if (sample.pdf == 0) return {};
    if (!scene.visible(point, frame.n, point + frame.to_world(sample.p))) return {};
    const float brdf = 1 / nusselt::kPi<float>;
    const Vec emission = scene.tube.radius * scene.tube.radiance; // pdf is density times radius, too
    return (brdf * sample.wi.z / sample.pdf) * emission;
}

/// Radiance of the lights themselves, for rays of the camera only: at later bounces light_of_panel() and
/// light_of_tube() have counted it.
Vec seen_light(const Scene& scene, const Vec& origin, const Vec& direction, float surface) {
    const auto& panel = scene.panel.shape;
    const float t = dot(panel.normal, panel.vertex[0] - origin) / dot(panel.normal, direction);
    bool inside = t > 0 && t < surface && dot(panel.normal, direction) < 0;
    for (int j = 0; j < 4; ++j) {
        const Vec inwards = cross(panel.normal, panel.edge[j]);
        inside = inside && dot(inwards, origin + t * direction - panel.vertex[j]) >= 0;
    }
    if (inside) return scene.panel.radiance;

    // Where the ray passes the axis of the tube at the smallest distance.
    const auto& line = scene.tube.shape;
    const Vec offset = line.p0 - origin;
    const float cosine = dot(line.s, direction);
    const float along = (cosine * dot(offset, direction) - dot(offset, line.s)) / (1 - cosine * cosine);
    if (!(along >= 0 && along <= line.length)) return {};
    const Vec closest = offset + along * line.s;
    const float distance = dot(closest, direction);
    const bool hit =
        distance > 0 && distance < surface && length(closest - distance * direction) < scene.tube.radius;
    return hit ? scene.tube.radiance : Vec{};
}

/// Radiance that arrives at a point from a direction.
Vec radiance(const Scene& scene, Vec origin, Vec direction, int bounces, Random& random) {
    Hit hit = scene.closest(origin, direction);
    Vec sum = seen_light(scene, origin, direction, hit.distance);
    if (sum.x + sum.y + sum.z > 0) return sum;
    Vec throughput{1, 1, 1};
    for (int bounce = 0; hit.distance < kNowhere; ++bounce) {
        const Vec point = origin + hit.distance * direction;
        const Vec normal = dot(hit.normal, direction) < 0 ? hit.normal : -hit.normal;
        const auto frame = Frame<float>::from_normal(normal);
        throughput = tint(throughput, hit.albedo);
        const Vec panel = light_of_panel(scene, point, frame, random);
        const Vec tube = light_of_tube(scene, point, frame, random);
        sum = sum + tint(throughput, panel + tube);
        if (bounce == bounces) break;
        // Uniform in projected solid angle, so that the BRDF, the cosine and the density leave the albedo.
        const float radius = std::sqrt(random.next());
        const float azimuth = 2 * nusselt::kPi<float> * random.next();
        const float x = radius * std::cos(azimuth);
        const float y = radius * std::sin(azimuth);
        const float z2 = 1 - x * x - y * y;
        direction = frame.to_world({x, y, std::sqrt(z2 > 0 ? z2 : 0)});
        origin = point + kOffset * normal;
        hit = scene.closest(origin, direction);
    }
    return sum;
}

/// A room without a front wall, 4 m wide, 2.6 m high and 4 m deep.
Scene make_scene() {
    const Vec white{0.75f, 0.75f, 0.75f}, red{0.63f, 0.06f, 0.05f}, green{0.14f, 0.45f, 0.09f};
    // Clockwise as seen from above, so that the normal points down.
    const Vec corners[] = {
        {-0.9f, 2.5f, -2.2f}, {0.5f, 2.3f, -2.2f}, {0.5f, 2.3f, -1.6f}, {-0.9f, 2.5f, -1.6f}};
    Scene scene;
    scene.rectangles = {{{-2, 0, 0}, {4, 0, 0}, {0, 0, -4}, white},
                        {{-2, 2.6f, 0}, {4, 0, 0}, {0, 0, -4}, white},
                        {{-2, 0, -4}, {4, 0, 0}, {0, 2.6f, 0}, white},
                        {{-2, 0, 0}, {0, 0, -4}, {0, 2.6f, 0}, red},
                        {{2, 0, 0}, {0, 0, -4}, {0, 2.6f, 0}, green}};
    scene.spheres = {{{-0.7f, 0.6f, -2.6f}, 0.6f, white}, {{0.7f, 0.4f, -1.5f}, 0.4f, white}};
    scene.panel = {nusselt::make_polygon<4>(corners, 4), {9, 8, 6}};
    scene.tube = {nusselt::make_line(Vec{1.3f, 0.1f, -3.5f}, Vec{1.7f, 2.2f, -3.2f}), 0.02f, {12, 20, 40}};
    return scene;
}

/// Rows from top to bottom.
std::vector<Vec> render(const Scene& scene, int width, int height, int samples, int bounces) {
    std::vector<Vec> pixels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Random random(static_cast<std::uint32_t>(y * width + x));
            Vec sum{};
            for (int i = 0; i < samples; ++i) {
                const float px = (static_cast<float>(x) + random.next()) / static_cast<float>(width) - 0.5f;
                const float py = (static_cast<float>(y) + random.next()) / static_cast<float>(height) - 0.5f;
                const float aspect = static_cast<float>(width) / static_cast<float>(height);
                const Vec direction = nusselt::normalize(Vec{aspect * px, -py, -1});
                sum = sum + radiance(scene, kEye, direction, bounces, random);
            }
            pixels.push_back((1 / static_cast<float>(samples)) * sum);
        }
    }
    return pixels;
}

int to_srgb(float x) {
    const float clamped = x < 0 ? 0 : x > 1 ? 1 : x;
    const float encoded =
        clamped < 0.0031308f ? 12.92f * clamped : 1.055f * std::pow(clamped, 1 / 2.4f) - 0.055f;
    return static_cast<int>(255 * encoded + 0.5f);
}

} // namespace

int main(int argc, char** argv) {
    const std::string file = argc > 1 ? argv[1] : "room.ppm";
    const int width = argc > 2 ? std::atoi(argv[2]) : 320;
    const int samples = argc > 3 ? std::atoi(argv[3]) : 32;
    const int height = width * 3 / 4;
    if (width < 2 || samples < 1)
        return std::fputs("usage: path_tracer [FILE.ppm [WIDTH [SAMPLES]]]\n", stderr), 2;
    const std::vector<Vec> pixels = render(make_scene(), width, height, samples, 4);
    std::FILE* out = std::fopen(file.c_str(), "wb");
    if (!out) return std::fprintf(stderr, "cannot write %s\n", file.c_str()), 1;
    std::fprintf(out, "P6\n%d %d\n255\n", width, height);
    for (const Vec& c : pixels)
        for (const float x : {c.x, c.y, c.z}) std::fputc(to_srgb(x), out);
    return std::fclose(out) == 0 ? 0 : 1;
}
