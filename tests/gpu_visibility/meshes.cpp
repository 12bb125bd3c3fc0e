#include "meshes.h"

#include <cmath>
#include <numbers>

namespace nusselt::gpu_visibility_test {

using scene::Float3;

namespace {

using Uniform = std::uniform_real_distribution<float>;

Ray ray_between(const Float3& a, const Float3& b, float t_far) {
    return {{a.x, a.y, a.z}, {b.x - a.x, b.y - a.y, b.z - a.z}, t_far};
}

Float3 random_point(float size, std::mt19937& random) {
    Uniform uniform(-size, size);
    const float x = uniform(random);
    const float y = uniform(random);
    return {x, y, uniform(random)};
}

} // namespace

void add_bumpy_sphere(scene::Scene& scene, int rings, int sectors, const Float3& centre, std::mt19937& random,
                      std::uint32_t material) {
    Uniform radius(0.7f, 1.3f);
    // The poles are one point each, the seam is closed.
    std::vector<std::vector<Float3>> grid(static_cast<std::size_t>(rings) + 1);
    for (int ring = 0; ring <= rings; ++ring) {
        const double theta = std::numbers::pi * ring / rings;
        auto& row = grid[static_cast<std::size_t>(ring)];
        for (int sector = 0; sector < sectors; ++sector) {
            const double phi = 2 * std::numbers::pi * sector / sectors;
            const float r = radius(random);
            row.push_back({centre.x + r * static_cast<float>(std::sin(theta) * std::cos(phi)),
                           centre.y + r * static_cast<float>(std::sin(theta) * std::sin(phi)),
                           centre.z + r * static_cast<float>(std::cos(theta))});
        }
        if (ring == 0 || ring == rings) row.assign(row.size(), row.front());
        row.push_back(row.front());
    }
    for (std::size_t i = 0; i < grid.size() - 1; ++i)
        for (std::size_t j = 0; j < grid[i].size() - 1; ++j) {
            const auto add = [&](const Float3& a, const Float3& b, const Float3& c) {
                visibility_test::add_triangle(scene, a, b, c, material);
            };
            if (i > 0) add(grid[i][j], grid[i + 1][j], grid[i][j + 1]);
            if (i + 2 < grid.size()) add(grid[i][j + 1], grid[i + 1][j], grid[i + 1][j + 1]);
            if (i + 2 == grid.size() && i == 0) add(grid[i][j], grid[i + 1][j], grid[i + 1][j + 1]);
        }
}

void add_needles(scene::Scene& scene, int count, std::mt19937& random) {
    for (int i = 0; i < count; ++i) {
        const Float3 a = random_point(1, random);
        const Float3 along = random_point(1, random);
        const Float3 across = random_point(0.001f, random);
        visibility_test::add_triangle(
            scene, a, {a.x + along.x, a.y + along.y, a.z + along.z},
            {a.x + along.x / 2 + across.x, a.y + along.y / 2 + across.y, a.z + along.z / 2 + across.z});
    }
}

std::vector<Ray> random_rays(std::size_t count, std::mt19937& random) {
    std::vector<Ray> rays;
    Uniform uniform(0.1f, 3);
    for (std::size_t i = 0; i < count; ++i) {
        const Float3 a = random_point(2, random);
        const Float3 b = random_point(2, random);
        rays.push_back(ray_between(a, b, uniform(random)));
    }
    return rays;
}

std::vector<Ray> rays_through_triangles(const scene::Scene& scene, const Float3& centre,
                                        std::mt19937& random) {
    std::vector<Ray> rays;
    Uniform unit(0, 1);
    for (const scene::Triangle& triangle : scene.triangles) {
        const auto add_ray = [&](float u, float v) {
            const Float3& a = scene.positions[triangle.vertex[0]];
            const Float3& b = scene.positions[triangle.vertex[1]];
            const Float3& c = scene.positions[triangle.vertex[2]];
            const Float3 target = {a.x + u * (b.x - a.x) + v * (c.x - a.x),
                                   a.y + u * (b.y - a.y) + v * (c.y - a.y),
                                   a.z + u * (b.z - a.z) + v * (c.z - a.z)};
            const Float3 shift = random_point(0.2f, random);
            rays.push_back(
                ray_between({centre.x + shift.x, centre.y + shift.y, centre.z + shift.z}, target, 5));
        };
        add_ray(0, 0);
        add_ray(1, 0);
        add_ray(0, 1);
        for (int i = 0; i < 4; ++i) {
            const float s = unit(random);
            add_ray(s, 0);
            add_ray(0, s);
            add_ray(s, 1 - s);
            add_ray(s / 2, (1 - s) / 2);
        }
    }
    return rays;
}

void add_instances(scene::Scene& scene, std::uint32_t object, std::mt19937& random) {
    Uniform uniform(-1, 1);
    for (int i = 0; i < 8; ++i) {
        scene::Instance instance;
        instance.object = object;
        // Half of random matrices mirror.
        for (std::size_t k = 0; k < 12; ++k) instance.world_from_object[k] = uniform(random);
        scene.instances.push_back(instance);
    }
    // Thin as paper, and one of another size.
    scene.instances.push_back({object, {1, 0, 0, 0.1f, 0, 1, 0, 0.2f, 0, 0, 0.001f, 0.3f}});
    scene.instances.push_back({object, {-0.01f, 0, 0, 0.5f, 0, 0.01f, 0, 0.5f, 0, 0, 0.01f, 0.5f}});
}

} // namespace nusselt::gpu_visibility_test
