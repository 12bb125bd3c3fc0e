/// Rays against the exact surfaces of round lights, through Embree: as a quadratic equation in long double says.

#include "visibility/round_surfaces.h"

#include "common/effort.h"

#include "base/isa.h"
#include "scene/model/lights/light_geometry.h"
#include "visibility/embree_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace nusselt::visibility_test {
namespace {

using scene::Double3;
using scene::Float3;
using scene::RoundLight;
using scene::RoundModel;
using visibility::HitPacket;
using visibility::PacketTracer;
using visibility::RayPacket;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Case {
    std::string name;
    RoundLight light;
};

RoundLight sphere(const Float3& center, float radius) {
    return {.center = center, .u = {radius, 0, 0}, .v = {0, radius, 0}, .w = {0, 0, radius}};
}

std::vector<Case> cases() {
    RoundLight sheared = sphere({-0.2f, 0.1f, 0.9f}, 0.3f);
    sheared.u = {0.3f, 0.2f, 0.1f};
    sheared.w = {0.2f, 0, -0.4f};
    RoundLight lens = sphere({2, 1, 0}, 1);
    lens.w = {0, 1e-3f, 1e-3f};
    RoundLight needle = sphere({0, 1, 0}, 1e-3f);
    needle.u = {1, 1, 0};
    RoundLight disk = {.model = RoundModel::ellipse,
                       .center = {0.5f, 0, 1},
                       .u = {0.4f, 0, 0},
                       .v = {0, -0.4f, 0},
                       .w = {0, 0, 0}};
    RoundLight oblique = disk;
    oblique.u = {0.3f, 0.1f, 0.2f};
    oblique.v = {0, -0.5f, 0.1f};
    return {{"sphere", sphere({0, 0, 0}, 1)},
            {"tiny_sphere", sphere({0.5f, 0.25f, 1}, 1e-4f)},
            {"huge_sphere", sphere({3e5f, -2e5f, 1e6f}, 1e6f)},
            {"sphere_far_from_the_origin", sphere({1000, -2000, 500}, 1)},
            {"sheared_ellipsoid", sheared},
            {"lens", lens},
            {"needle", needle},
            {"disk", disk},
            {"oblique_ellipse", oblique}};
}

bool is_flat(const RoundLight& light) { return light.model == RoundModel::ellipse; }

/// A scene of one light, of few triangles: rays do not meet them.
scene::Scene make_scene(const RoundLight& light) {
    scene::Scene scene;
    scene.materials.push_back({.name = "grey"});
    scene.emitters.push_back({"light"});
    scene::LightSurface surface = scene::surface(light, 4);
    scene.positions = surface.positions;
    scene.normals = surface.normals;
    scene.uvs = surface.uvs;
    scene.triangles = surface.triangles;
    scene.triangle_material.assign(scene.triangles.size(), 0);
    scene.triangle_light.assign(scene.triangles.size(), 0);
    scene.lights.of<RoundLight>().push_back(light);
    return scene;
}

struct Long3 {
    long double x, y, z;
};
Long3 to_long(const Float3& v) { return {v.x, v.y, v.z}; }
Long3 operator+(const Long3& a, const Long3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Long3 operator-(const Long3& a, const Long3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Long3 operator*(long double s, const Long3& v) { return {s * v.x, s * v.y, s * v.z}; }
long double dot(const Long3& a, const Long3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Long3 cross(const Long3& a, const Long3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Ray {
    Float3 origin, direction;
};

/// The space of the unit sphere.
struct UnitSpace {
    explicit UnitSpace(const RoundLight& light)
        : center(to_long(light.center)),
          u(to_long(light.u)),
          v(to_long(light.v)),
          w(is_flat(light) ? cross(u, v) : to_long(light.w)) {}
    Long3 to_unit(const Long3& p) const {
        const long double volume = dot(u, cross(v, w));
        return {dot(cross(v, w), p) / volume, dot(cross(w, u), p) / volume, dot(cross(u, v), p) / volume};
    }
    /// \param shift in world space
    Float3 to_world(const Long3& p, const Long3& shift = {}) const {
        const Long3 q = center + p.x * u + p.y * v + p.z * w + shift;
        return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
    }
    /// Unit, in world space.
    Long3 normal(const Long3& p) const {
        const Long3 n = p.x * cross(v, w) + p.y * cross(w, u) + p.z * cross(u, v);
        const long double side = dot(u, cross(v, w)) < 0 ? -1 : 1;
        return (side / std::sqrt(dot(n, n))) * n;
    }
    long double size() const { return std::sqrt(dot(u, u) + dot(v, v) + dot(w, w)); }
    Long3 center, u, v, w;
};

/// How far from a surface renderers let shadow rays start, in a scene that is as large as the light.
long double offset_at(const UnitSpace& space, const Long3& p) {
    const Float3 at = space.to_world(p);
    return 1e-5L * space.size() + 1e-6L * std::max({std::fabs(at.x), std::fabs(at.y), std::fabs(at.z)});
}

/// The first crossing with a positive t.
struct Reference {
    Reference(const RoundLight& light, const Ray& ray) {
        const UnitSpace space(light);
        const Long3 o = space.to_unit(to_long(ray.origin) - space.center);
        const Long3 d = space.to_unit(to_long(ray.direction));
        size = std::sqrt(dot(d, d));
        distance = std::sqrt(dot(o, o));
        if (is_flat(light)) {
            t = -o.z / d.z;
            point = o + t * d;
            gap = 1 - dot(point, point);
        } else {
            const long double middle = -dot(o, d) / dot(d, d);
            const Long3 closest = o + middle * d;
            gap = 1 - dot(closest, closest);
            const long double half = std::sqrt(std::max(gap, 0.0L)) / size;
            t = middle - half > 0 ? middle - half : middle + half;
            point = o + t * d;
        }
        hits = gap >= 0 && t > 0;
    }
    long double size;     ///< of the direction
    long double distance; ///< of the origin
    long double gap;      ///< negative for misses
    long double t;
    Long3 point;
    bool hits;
};

class Random {
public:
    explicit Random(unsigned seed) : generator_(seed) {}
    long double between(double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(generator_);
    }
    Long3 direction() {
        std::normal_distribution<double> normal;
        const Long3 v = {normal(generator_), normal(generator_), normal(generator_)};
        return (1 / std::sqrt(dot(v, v))) * v;
    }

private:
    std::mt19937 generator_;
};

Ray ray_between(const Float3& a, const Float3& b) { return {a, {b.x - a.x, b.y - a.y, b.z - a.z}}; }
Ray ray_between(const UnitSpace& space, const Long3& from, const Long3& to) {
    return ray_between(space.to_world(from), space.to_world(to));
}

/// Rays from all distances, from inside, and along the surface.
std::vector<Ray> random_rays(const RoundLight& light, int count) {
    const UnitSpace space(light);
    Random random(7);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Long3 p = random.direction();
        const Long3 q = random.direction();
        const Long3 across = cross(p, q);
        switch (i % 4) {
        case 0:
            rays.push_back(ray_between(space, random.between(1.01, 9) * p, random.between(0, 1.3) * q));
            break;
        case 1:
            rays.push_back(ray_between(space, 1e4L * p, random.between(0, 1.3) * q));
            break;
        case 2:
            rays.push_back(ray_between(space, random.between(0, 0.999) * p, q));
            break;
        default: {
            const long double height = 1 + random.between(-1e-3, 1e-3);
            rays.push_back(ray_between(space, height * p + random.between(1, 50) * across, height * p));
        }
        }
    }
    return rays;
}

template <class Width>
class RoundSurfaces : public testing::Test {
protected:
    static constexpr int kWidth = Width::value;

    /// Only kernels for AVX-512 trace packets of 16 rays. Embree gets their masks wrong on other processors.
    void SetUp() override {
        if (kWidth == 16 && !is_supported(base::Isa::avx512)) GTEST_SKIP() << "this processor lacks AVX-512";
    }

    struct Hit {
        std::int32_t triangle, light, round;
        float u, v, t;
        Long3 point;
    };

    template <class Visit>
    void trace(const scene::Scene& scene, const std::vector<Ray>& rays, float t_far, const Visit& visit) {
        const visibility::EmbreeScene embree(scene);
        const visibility::RayTracer tracer = embree.tracer();
        for (std::size_t first = 0; first < rays.size(); first += kWidth) {
            RayPacket<kWidth> packet{};
            std::uint32_t active = 0;
            for (int i = 0; i < kWidth && first + static_cast<std::size_t>(i) < rays.size(); ++i) {
                const auto& [o, d] = rays[first + static_cast<std::size_t>(i)];
                const float values[] = {o.x, o.y, o.z, d.x, d.y, d.z};
                for (int k = 0; k < 3; ++k) {
                    packet.origin[k][i] = values[k];
                    packet.direction[k][i] = values[k + 3];
                }
                packet.t_far[i] = t_far;
                active |= 1u << i;
            }
            visit(static_cast<const PacketTracer<kWidth>&>(tracer), tracer.context, active, packet);
        }
    }

    std::vector<Hit> intersect(const scene::Scene& scene, const std::vector<Ray>& rays) {
        std::vector<Hit> result;
        trace(scene, rays, kInfinity,
              [&](const auto& tracer, const void* context, auto active, const auto& packet) {
                  HitPacket<kWidth> hits;
                  tracer.intersect(context, active, packet, hits);
                  for (int i = 0; i < kWidth; ++i)
                      if ((active >> i & 1u) != 0)
                          result.push_back({hits.triangle[i],
                                            hits.light[i],
                                            hits.round[i],
                                            hits.u[i],
                                            hits.v[i],
                                            hits.t[i],
                                            {hits.unit[0][i], hits.unit[1][i], hits.unit[2][i]}});
              });
        return result;
    }

    /// How many rays something blocks.
    int count_blocked(const scene::Scene& scene, const std::vector<Ray>& rays, float t_far) {
        int count = 0;
        trace(scene, rays, t_far,
              [&](const auto& tracer, const void* context, auto active, const auto& packet) {
                  count += __builtin_popcount(tracer.occluded(context, active, packet));
              });
        return count;
    }

    /// The number of rays that a light meets in other places than the reference.
    int count_errors(const RoundLight& light, const RoundLight& reference, const std::vector<Ray>& rays) {
        const std::vector<Hit> hits = intersect(make_scene(light), rays);
        int errors = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Reference expected(reference, rays[i]);
            // Rays along the surface may miss it or not.
            const long double rounding = 1e-10L * (1 + expected.distance);
            if (std::fabs(expected.gap) < rounding) continue;
            const bool is_hit = hits[i].triangle >= 0;
            if (is_hit != expected.hits || is_hit != (hits[i].round == 0)) ++errors;
            if (!is_hit || !expected.hits) continue;
            const long double tolerance = expected.gap > 1e-5L ? 1e-6L : 3e-5L;
            const Long3 difference = hits[i].point - expected.point;
            const long double of_t = std::fabs(hits[i].t - expected.t);
            if (!(std::sqrt(dot(difference, difference)) < tolerance)) ++errors;
            if (!(of_t < 1.2e-7L * expected.t + tolerance / expected.size)) ++errors;
        }
        return errors;
    }
};

using Widths = testing::Types<std::integral_constant<int, 4>, std::integral_constant<int, 8>,
                              std::integral_constant<int, 16>>;
TYPED_TEST_SUITE(RoundSurfaces, Widths);

TYPED_TEST(RoundSurfaces, AreMetWhereTheEquationSays) {
    const int count = nusselt_test::at_effort(4000, 400'000);
    for (const Case& c : cases()) {
        const std::vector<Ray> rays = random_rays(c.light, count);
        EXPECT_EQ(this->count_errors(c.light, c.light, rays), 0) << c.name;
        // The test sees that a shape is wrong by a thousandth.
        RoundLight wrong = c.light;
        for (float* x : {&wrong.u.x, &wrong.u.y, &wrong.u.z}) *x *= 1.001f;
        EXPECT_GT(this->count_errors(wrong, c.light, rays), count / 10) << c.name;
    }
}

/// Shadow rays from the surface, from either side of it, and to it.
TYPED_TEST(RoundSurfaces, DoNotHideThemselves) {
    const int count = nusselt_test::at_effort(2000, 200'000);
    for (const Case& c : cases()) {
        const UnitSpace space(c.light);
        Random random(3);
        std::vector<Ray> towards, away, inside, beyond, through;
        for (int i = 0; i < count; ++i) {
            Long3 p = random.direction(), q = random.direction();
            if (is_flat(c.light)) p.z = q.z = 0;
            const long double height = is_flat(c.light) ? random.between(0.01, 3) : 0;
            Long3 from = is_flat(c.light) ? random.between(-2, 2) * p : random.between(1.001, 3) * p;
            from.z += height;
            // From outside, the side that faces the point.
            if (is_flat(c.light) || dot(from, q) > 1) towards.push_back(ray_between(space, from, q));
            if (is_flat(c.light)) continue;
            const Long3 normal = space.normal(p);
            const long double offset = offset_at(space, p);
            const Float3 outside = space.to_world(p, offset * normal);
            // Half of a sphere around a point above the surface.
            Long3 up = random.direction();
            if (dot(up, normal) < 0) up = -1.0L * up;
            away.push_back(ray_between(outside, space.to_world(p, 2 * offset * normal + space.size() * up)));
            const Float3 within = space.to_world(p, -offset * normal);
            const Long3 depth = space.to_unit(to_long(within) - space.center);
            // Edges of lenses are thinner than the offset.
            if (dot(depth, depth) > 1) continue;
            inside.push_back(ray_between(within, space.to_world(q)));
            if (dot(p, q) > 0.5L) continue;
            beyond.push_back(ray_between(within, space.to_world(1.1L * q)));
            through.push_back(ray_between(space, 1.01L * p, 1.01L * q));
        }
        const scene::Scene scene = make_scene(c.light);
        constexpr float kShadowEnd = 0.9999f;
        EXPECT_EQ(this->count_blocked(scene, towards, kShadowEnd), 0) << c.name;
        EXPECT_EQ(this->count_blocked(scene, away, kShadowEnd), 0) << c.name;
        EXPECT_GE(static_cast<int>(inside.size()), is_flat(c.light) ? 0 : count * 9 / 10);
        EXPECT_EQ(this->count_blocked(scene, inside, kShadowEnd), 0) << c.name;
        EXPECT_EQ(this->count_blocked(scene, beyond, 1), static_cast<int>(beyond.size())) << c.name;
        EXPECT_EQ(this->count_blocked(scene, through, 1), static_cast<int>(through.size())) << c.name;
    }
}

/// Shadow rays from one side of a flat light to the other.
TYPED_TEST(RoundSurfaces, HideWhatIsBehindDisks) {
    const int count = nusselt_test::at_effort(2000, 200'000);
    for (const Case& c : cases()) {
        if (!is_flat(c.light)) continue;
        const UnitSpace space(c.light);
        Random random(7);
        std::vector<Ray> through, beside;
        for (int i = 0; i < count; ++i) {
            const Long3 direction = random.direction();
            const long double share = 1 / std::sqrt(dot(direction, direction) - direction.z * direction.z);
            const Long3 rim = {share * direction.x, share * direction.y, 0};
            const Long3 way = {random.between(-1, 1), random.between(-1, 1), random.between(0.1, 2)};
            const auto across = [&](long double radius) {
                const Long3 middle = radius * rim;
                return ray_between(space, middle + -1.0L * way, middle + way);
            };
            through.push_back(across(0.99L * std::sqrt(random.between(0, 1))));
            beside.push_back(across(random.between(1.01, 3)));
        }
        const scene::Scene scene = make_scene(c.light);
        EXPECT_EQ(this->count_blocked(scene, through, 1), count) << c.name;
        EXPECT_EQ(this->count_blocked(scene, beside, 1), 0) << c.name;
    }
}

/// The ends of rays are off by the rounding of coordinates far from the origin.
TYPED_TEST(RoundSurfaces, DoNotHideDisksFarFromTheOrigin) {
    RoundLight disk = {.model = RoundModel::ellipse, .u = {1, 0, 0}, .v = {0, 0.6f, 0.8f}, .w = {0, 0, 0}};
    disk.center = {1000, -2000, 500};
    const UnitSpace space(disk);
    Random random(11);
    std::vector<Ray> rays;
    for (int i = 0; i < 20'000; ++i) {
        Long3 p = random.direction(), q = random.direction();
        p.z = q.z = 0;
        Long3 from = 3.0L * p;
        from.z = random.between(0.002, 0.1);
        rays.push_back(ray_between(space, from, q));
    }
    EXPECT_EQ(this->count_blocked(make_scene(disk), rays, 0.9999f), 0);
}

TYPED_TEST(RoundSurfaces, HaveTheTextureCoordinatesOfTheirTriangles) {
    for (const Case& c : cases()) {
        const scene::LightSurface surface = scene::surface(c.light, 12);
        std::vector<Ray> rays;
        std::vector<scene::Float2> expected;
        for (std::size_t i = 0; i < surface.positions.size(); ++i) {
            const Float3& p = surface.positions[i];
            const scene::Float2& uv = surface.uvs[i];
            // The seam has both ends of the range, and the poles have all angles.
            if (uv.x < 0.01f || uv.x > 0.99f || uv.y < 0.01f || uv.y > 0.99f) continue;
            const Float3& n = surface.normals[i];
            const float height = scene::semi_axes(c.light)[0] * 1e-2;
            rays.push_back(
                {{p.x + height * n.x, p.y + height * n.y, p.z + height * n.z}, {-n.x, -n.y, -n.z}});
            expected.push_back(uv);
        }
        const auto hits = this->intersect(make_scene(c.light), rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            // That of points in single precision.
            EXPECT_NEAR(hits[i].u, expected[i].x, 1e-3) << c.name;
            EXPECT_NEAR(hits[i].v, expected[i].y, 1e-3) << c.name;
        }
    }
}

/// Each of both sides is there with its alpha.
TYPED_TEST(RoundSurfaces, AreThereAsOftenAsAlphaSays) {
    scene::Scene scene = make_scene(sphere({0, 0, 0}, 1));
    scene.materials[0].alpha = 0.3f;
    const int count = 20'000;
    std::vector<Ray> rays;
    Random random(5);
    for (int i = 0; i < count; ++i) {
        const Long3 p = random.direction();
        rays.push_back(ray_between(UnitSpace(sphere({0, 0, 0}, 1)), 3.0L * p, 0.2L * random.direction()));
    }
    int first = 0, second = 0;
    for (const auto& hit : this->intersect(scene, rays)) {
        first += hit.round == 0 && hit.t < 1 ? 1 : 0;
        second += hit.round == 0 && hit.t > 1 ? 1 : 0;
    }
    // Six standard deviations.
    const double n = count;
    EXPECT_NEAR(first, 0.3 * n, 6 * std::sqrt(0.21 * n));
    EXPECT_NEAR(second, 0.21 * n, 6 * std::sqrt(0.21 * n));
    EXPECT_NEAR(this->count_blocked(scene, rays, 9), 0.51 * n, 6 * std::sqrt(0.25 * n));
    scene.materials[0].alpha = 0;
    EXPECT_EQ(this->count_blocked(scene, rays, 9), 0);

    // From inside, and through a disk, rays cross the surface once.
    const RoundLight disk = {.model = RoundModel::ellipse, .u = {1, 0, 0}, .v = {0, 1, 0}, .w = {0, 0, 0}};
    for (const RoundLight& light : {sphere({0, 0, 0}, 1), disk}) {
        scene::Scene once = make_scene(light);
        once.materials[0].alpha = 0.3f;
        std::vector<Ray> outwards;
        for (int i = 0; i < count; ++i) {
            const Long3 p = random.direction();
            const Long3 from = 0.5L * p;
            outwards.push_back(is_flat(light)
                                   ? ray_between(UnitSpace(light), {from.x, from.y, 1}, {from.x, from.y, -1})
                                   : ray_between(UnitSpace(light), from, 3.0L * p));
        }
        EXPECT_NEAR(this->count_blocked(once, outwards, 1), 0.3 * n, 6 * std::sqrt(0.21 * n));
    }
}

/// What no importer makes, but a program may.
TYPED_TEST(RoundSurfaces, WithoutExtentAreNotMet) {
    RoundLight line = sphere({0, 0, 0}, 1);
    line.v = line.w = {0, 0, 0};
    RoundLight flat = line;
    flat.model = RoundModel::ellipse;
    const std::vector<Ray> rays = random_rays(sphere({0, 0, 0}, 1), 200);
    for (const RoundLight& light : {line, flat}) {
        for (const auto& hit : this->intersect(make_scene(light), rays)) EXPECT_EQ(hit.round, -1);
        EXPECT_EQ(this->count_blocked(make_scene(light), rays, 1), 0);
    }
}

/// Disks have no thickness.
TYPED_TEST(RoundSurfaces, AreNotMetEdgeOn) {
    const RoundLight disk = {.model = RoundModel::ellipse, .u = {1, 0, 0}, .v = {0, 1, 0}, .w = {0, 0, 0}};
    const std::vector<Ray> rays = {
        {{-3, 0, 0}, {1, 0, 0}}, {{-3, 0, 1e-6f}, {1, 0, 0}}, {{0, 0, 0}, {0, 1, 0}}};
    for (const auto& hit : this->intersect(make_scene(disk), rays)) EXPECT_EQ(hit.round, -1);
    EXPECT_EQ(this->count_blocked(make_scene(disk), rays, 10), 0);
    // Almost: the near side of the rim, or its middle.
    const auto hits = this->intersect(make_scene(disk),
                                      {{{-3, 0, 2e-6f}, {1, 0, -1e-6f}}, {{-3, 0, 3e-6f}, {1, 0, -1e-6f}}});
    EXPECT_EQ(hits[0].round, 0);
    EXPECT_NEAR(static_cast<double>(hits[1].point.x), 0, 1e-6);
}

} // namespace
} // namespace nusselt::visibility_test
