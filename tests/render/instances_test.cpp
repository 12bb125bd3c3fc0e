/// Copies of objects against the same triangles in world space.

#include "scenes.h"

#include "image/metrics.h"
#include "visibility/embree_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nusselt::render_test {
namespace {

constexpr int kSize = 96;

using Matrix = std::array<float, 12>;

/// A rotation about z and then a scale per axis, a shear of x by z, and a translation.
Matrix transform(double angle, const Float3& scale, float shear, const Float3& translation) {
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    return {scale.x * c, -scale.x * s,
            shear,       translation.x, //
            scale.y * s, scale.y * c,
            0,           translation.y, //
            0,           0,
            scale.z,     translation.z};
}

/// A closed body with a radius of about 1 that looks different from all sides.
/// \param normal_length 0 for a body with facets
void add_body(scene::Scene& scene, std::uint32_t material, const Float3& center, float normal_length) {
    constexpr int kRings = 12;
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int i = 0; i <= kRings; ++i)
        for (int j = 0; j < 2 * kRings; ++j) {
            const double theta = 3.14159265358979 * i / kRings;
            const double phi = 3.14159265358979 * j / kRings;
            const double r = (1 + 0.2 * std::cos(phi) + 0.1 * std::sin(3 * theta)) * std::sin(theta);
            const Float3 p{static_cast<float>(r * std::cos(phi)), static_cast<float>(0.7 * r * std::sin(phi)),
                           static_cast<float>(std::cos(theta))};
            scene.positions.push_back({p.x + center.x, p.y + center.y, p.z + center.z});
            scene.normals.push_back({normal_length * p.x, normal_length * 2 * p.y, normal_length * p.z});
            scene.uvs.push_back({static_cast<float>(phi), static_cast<float>(theta)});
        }
    const auto index = [&](int i, int j) {
        return first + static_cast<std::uint32_t>(i * 2 * kRings + j % (2 * kRings));
    };
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < 2 * kRings; ++j)
            for (const scene::Triangle& triangle :
                 {scene::Triangle{{index(i, j), index(i + 1, j), index(i, j + 1)}},
                  scene::Triangle{{index(i, j + 1), index(i + 1, j), index(i + 1, j + 1)}}}) {
                scene.triangles.push_back(triangle);
                scene.triangle_material.push_back(material);
                scene.triangle_light.push_back(-1);
            }
}

/// The box with copies of two bumpy objects, a smooth one and one with facets. \param center of the objects in their own coordinates
scene::Scene make_instanced_scene(const std::vector<scene::Instance>& instances, const Float3& center) {
    scene::Scene scene = make_box_scene(kSize);
    scene::Texture bumps;
    bumps.width = bumps.height = 4;
    bumps.channels = 1;
    for (int i = 0; i < 16; ++i) bumps.texels.push_back(static_cast<float>(i * 7 % 5));
    scene.textures = {bumps};
    for (std::uint32_t material = 0; material < 2; ++material) {
        scene.materials[material].bump = 0.01f;
        scene.materials[material].bump_texture.texture = 0;
        const auto first = static_cast<std::uint32_t>(scene.triangles.size());
        add_body(scene, material, center, material == 0 ? 1.0f : 0.0f);
        const auto count = static_cast<std::uint32_t>(scene.triangles.size()) - first;
        scene.objects.push_back({"body", first, count});
    }
    scene.instances = instances;
    return scene;
}

using NormalTransform = Float3 (*)(const Matrix&, const Float3&);

/// The linear part times v.
Float3 linear(const Matrix& m, const Float3& v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
            m[8] * v.x + m[9] * v.y + m[10] * v.z};
}

float cofactor(const Matrix& m, int i, int j) {
    const auto entry = [&](int row, int column) {
        return m[static_cast<std::size_t>(4 * (row % 3) + column % 3)];
    };
    return entry(i + 1, j + 1) * entry(i + 2, j + 2) - entry(i + 1, j + 2) * entry(i + 2, j + 1);
}

float handedness(const Matrix& m) {
    const float determinant = m[0] * cofactor(m, 0, 0) + m[1] * cofactor(m, 0, 1) + m[2] * cofactor(m, 0, 2);
    return std::copysign(1.0f, determinant);
}

/// The inverse transpose times n, except for its length.
Float3 transformed_normal(const Matrix& m, const Float3& n) {
    const auto row = [&](int i) {
        return handedness(m) * (cofactor(m, i, 0) * n.x + cofactor(m, i, 1) * n.y + cofactor(m, i, 2) * n.z);
    };
    return {row(0), row(1), row(2)};
}

/// The same scene with a copy of each object's triangles per instance.
scene::Scene flattened(const scene::Scene& scene, NormalTransform transform_normal) {
    scene::Scene flat = scene;
    flat.objects.clear();
    flat.instances.clear();
    const std::size_t world = world_triangle_count(scene);
    flat.triangles.resize(world);
    flat.triangle_material.resize(world);
    flat.triangle_light.resize(world);
    for (const scene::Instance& instance : scene.instances) {
        const scene::Object& object = scene.objects[instance.object];
        const Matrix& m = instance.world_from_object;
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            const std::uint32_t source = object.first_triangle + i;
            scene::Triangle copy;
            for (int k = 0; k < 3; ++k) {
                // Mirror images keep their front side.
                const int corner = handedness(m) < 0 ? (3 - k) % 3 : k;
                const std::uint32_t vertex = scene.triangles[source].vertex[corner];
                copy.vertex[k] = static_cast<std::uint32_t>(flat.positions.size());
                const Float3 p = linear(m, scene.positions[vertex]);
                flat.positions.push_back({p.x + m[3], p.y + m[7], p.z + m[11]});
                // All normals of a triangle are scaled alike: interpolation sees the same direction.
                flat.normals.push_back(transform_normal(m, scene.normals[vertex]));
                flat.uvs.push_back(scene.uvs[vertex]);
            }
            flat.triangles.push_back(copy);
            flat.triangle_material.push_back(scene.triangle_material[source]);
            flat.triangle_light.push_back(-1);
        }
    }
    return flat;
}

image::Image render(const scene::Scene& scene, base::Isa isa) {
    render::RenderSettings settings;
    settings.samples = 4;
    const auto result = render_cpu::Renderer(scene, 2).render(settings, isa);
    EXPECT_EQ(result.statistics.rejected_samples, 0u);
    return result.image;
}

struct Case {
    const char* name;
    std::vector<scene::Instance> instances;
};

const float kThird = 0.3f;

const Case kCases[] = {
    {"rotated",
     {{0, transform(0.4, {kThird, kThird, kThird}, 0, {0.5f, -0.3f, 1.2f})},
      {1, transform(2.4, {0.2f, 0.2f, 0.2f}, 0, {-0.4f, -0.6f, 1.4f})}}},
    {"mirrored",
     {{0, transform(0.4, {-kThird, kThird, kThird}, 0, {0.5f, -0.3f, 1.2f})},
      {1, transform(1.4, {0.2f, 0.2f, -0.2f}, 0, {-0.4f, -0.6f, 1.4f})}}},
    {"stretched",
     {{0, transform(0.4, {0.1f, 0.4f, kThird}, 0, {0.5f, -0.3f, 1.2f})},
      {0, transform(1.9, {0.6f, 0.3f, 0.05f}, 0, {0, -0.5f, 0.2f})},
      {1, transform(0.7, {-0.3f, 0.1f, 0.2f}, 0, {-0.4f, -0.6f, 1.4f})}}},
    {"sheared",
     {{1, transform(0.4, {0.2f, 0.2f, kThird}, 0.3f, {0.5f, -0.3f, 1.2f})},
      {0, transform(2.0, {0.3f, -0.3f, 0.3f}, -0.2f, {-0.4f, -0.6f, 1.4f})}}},
};

class Instances : public testing::TestWithParam<Case> {};

/// Edges of surfaces and shadows may fall on other sides of samples: those pixels are few. A matte surface with wrong
/// normals differs nearly everywhere.
constexpr double kTolerance = 1e-3;
constexpr double kLargestShare = 2e-3;

TEST_P(Instances, LookLikeCopiesOfTheirTriangles) {
    const scene::Scene scene = make_instanced_scene(GetParam().instances, {0, 0, 0});
    const scene::Scene flat = flattened(scene, transformed_normal);
    for (const auto isa : base::kAllIsas) {
        if (!is_supported(isa)) continue;
        const image::Image expected = render(flat, isa);
        EXPECT_LE(differing_share(render(scene, isa), expected, kTolerance, 0), kLargestShare)
            << name_of(isa);
        // They are in the picture at all.
        scene::Scene empty = scene;
        empty.instances.clear();
        EXPECT_GT(differing_share(render(empty, isa), expected, kTolerance, 0), 0.1);
    }
}

TEST_P(Instances, TheTestTellsWrongNormals) {
    const std::string name = GetParam().name;
    if (name != "stretched" && name != "sheared") return;
    const scene::Scene scene = make_instanced_scene(GetParam().instances, {0, 0, 0});
    const auto isa = base::choose_isa();
    EXPECT_GT(differing_share(render(scene, isa), render(flattened(scene, linear), isa), kTolerance, 0),
              10 * kLargestShare);
}

INSTANTIATE_TEST_SUITE_P(Transforms, Instances, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

/// Coordinates of the object cancel against the translation. Shadow rays must start far enough from the surface
/// nevertheless: else the body would shadow itself.
TEST(InstanceOffsets, CoverTheRoundingOfLargeObjectCoordinates) {
    const auto at = [](const Float3& center) {
        Matrix m = transform(0.4, {0.5f, 0.5f, 0.5f}, 0, {0, 0, 0});
        const Float3 moved = linear(m, center);
        m[3] = 0.2f - moved.x;
        m[7] = -0.3f - moved.y;
        m[11] = 1.1f - moved.z;
        return make_instanced_scene({{0, m}}, center);
    };
    const auto isa = base::choose_isa();
    const image::Image reference = render(at({0, 0, 0}), isa);
    const image::Image moved = render(at({4000, -6000, 8000}), isa);
    // A tenth of all pixels with offsets for the coordinates in the world.
    EXPECT_LE(differing_share(moved, reference, 0.05, 0), 0.01);
}

TEST(InstanceHits, NameTriangleAndInstance) {
    scene::Scene scene = make_instanced_scene(kCases[0].instances, {0, 0, 0});
    scene.positions.push_back({0, 0, 0});
    // An object without triangles is no obstacle.
    scene.objects.push_back({"nothing", static_cast<std::uint32_t>(scene.triangles.size()), 0});
    scene.instances.insert(scene.instances.begin(), {2, transform(0, {1, 1, 1}, 0, {0, 0, 0})});
    const visibility::EmbreeScene embree(scene);
    const visibility::RayTracer tracer = embree.tracer();
    const visibility::PacketTracer<4>& trace = tracer;
    // The targets are the middles of the first body, of the second one, of a tube, and of the back wall.
    const Float3 targets[] = {{0.5f, -0.3f, 1.2f}, {-0.4f, -0.6f, 1.4f}, {-0.7f, -0.2f, 1.35f}, {0, 1, 1.7f}};
    visibility::RayPacket<4> rays{};
    for (int i = 0; i < 4; ++i) {
        rays.origin[1][i] = -4;
        rays.origin[2][i] = 1;
        rays.direction[0][i] = targets[i].x;
        rays.direction[1][i] = targets[i].y + 4;
        rays.direction[2][i] = targets[i].z - 1;
        rays.t_far[i] = std::numeric_limits<float>::infinity();
    }
    visibility::HitPacket<4> hits;
    trace.intersect(tracer.context, 0b1111, rays, hits);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(hits.instance[i], i + 1);
        const scene::Object& object = scene.objects[scene.instances[static_cast<std::size_t>(i + 1)].object];
        ASSERT_GE(hits.triangle[i], static_cast<std::int32_t>(object.first_triangle));
        ASSERT_LT(hits.triangle[i], static_cast<std::int32_t>(object.first_triangle + object.triangle_count));
        // The point is on the ray.
        const scene::Triangle& triangle = scene.triangles[static_cast<std::size_t>(hits.triangle[i])];
        const Float3& a = scene.positions[triangle.vertex[0]];
        const Float3& b = scene.positions[triangle.vertex[1]];
        const Float3& c = scene.positions[triangle.vertex[2]];
        const auto mix = [&](float x, float y, float z) {
            return x + hits.u[i] * (y - x) + hits.v[i] * (z - x);
        };
        const Matrix& m = scene.instances[static_cast<std::size_t>(i + 1)].world_from_object;
        const Float3 p = linear(m, {mix(a.x, b.x, c.x), mix(a.y, b.y, c.y), mix(a.z, b.z, c.z)});
        const float t = (p.y + m[7] + 4) / rays.direction[1][i];
        EXPECT_NEAR(p.x + m[3], t * rays.direction[0][i], 1e-5f);
        EXPECT_NEAR(p.z + m[11] - 1, t * rays.direction[2][i], 1e-5f);
    }
    EXPECT_EQ(hits.light[2], 2); // behind the panel and the other tube
    EXPECT_EQ(hits.triangle[2], -1);
    EXPECT_GE(hits.triangle[3], 0);
    EXPECT_EQ(hits.instance[3], -1);

    // Shadow rays meet bodies, but not the tube; these stop in front of the wall.
    for (float& t_far : rays.t_far) t_far = 1;
    rays.t_far[3] = 0.99f;
    EXPECT_EQ(trace.occluded(tracer.context, 0b1111, rays), 0b0011u);
}

TEST(InstanceTransforms, ThatCannotBeInvertedAreErrors) {
    for (const Matrix& m : {transform(0, {1, 0, 1}, 0, {0, 0, 0}), transform(0, {0, 0, 0}, 0, {1, 1, 1}),
                            transform(0, {1, std::nanf(""), 1}, 0, {0, 0, 0})}) {
        const scene::Scene scene = make_instanced_scene({{0, m}}, {0, 0, 0});
        EXPECT_THROW(render_cpu::Renderer(scene, 1), std::runtime_error);
    }
}

} // namespace
} // namespace nusselt::render_test
