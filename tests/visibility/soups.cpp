#include "soups.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nusselt::visibility_test {

using scene::Float3;

namespace {

Float3 plus(const Float3& a, const Float3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

Float3 transformed(const std::array<float, 12>& m, const Float3& p) {
    const auto row = [&](std::size_t i) {
        return static_cast<float>(double{m[i]} * p.x + double{m[i + 1]} * p.y + double{m[i + 2]} * p.z +
                                  m[i + 3]);
    };
    return {row(0), row(4), row(8)};
}

} // namespace

scene::Scene make_empty_scene() {
    scene::Scene scene;
    scene.materials.resize(3);
    scene.materials[kPartial].alpha = 0.5f;
    scene.materials[kAbsent].alpha = 0;
    return scene;
}

void add_triangle(scene::Scene& scene, const Float3& a, const Float3& b, const Float3& c,
                  std::uint32_t material, std::int32_t light) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const Float3& corner : {a, b, c}) {
        scene.positions.push_back(corner);
        scene.normals.push_back({0, 0, 0});
        scene.uvs.push_back({0, 0});
    }
    scene.triangles.push_back({{first, first + 1, first + 2}});
    scene.triangle_material.push_back(material);
    scene.triangle_light.push_back(light);
}

void add_light(scene::Scene& scene, const Float3& corner, const Float3& u, const Float3& v) {
    const auto index = static_cast<std::int32_t>(scene.lights.of<scene::PolygonLight>().size());
    scene::PolygonLight light;
    light.vertices = {corner, plus(corner, u), plus(plus(corner, u), v), plus(corner, v)};
    light.radiance = {1, 1, 1};
    scene.lights.of<scene::PolygonLight>().push_back(light);
    add_triangle(scene, light.vertices[0], light.vertices[1], light.vertices[2], kFull, index);
    add_triangle(scene, light.vertices[0], light.vertices[2], light.vertices[3], kFull, index);
}

void add_ceiling_light(scene::Scene& scene) { add_light(scene, {-1, -0.75f, 2}, {2, 0, 0}, {0, 1.5f, 0}); }

void add_soup(scene::Scene& scene, int count, std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto point = [&](float size) {
        return Float3{size * uniform(random), size * uniform(random), size * uniform(random)};
    };
    for (int i = 0; i < count; ++i) {
        const Float3 centre = point(1);
        const float size = std::exp2(-4 + 3 * uniform(random));
        add_triangle(scene, plus(centre, point(size)), plus(centre, point(size)), plus(centre, point(size)));
    }
}

void add_box(scene::Scene& scene, const Float3& low, const Float3& high) {
    const auto corner = [&](int i) {
        return Float3{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                      (i & 4) != 0 ? high.z : low.z};
    };
    for (const std::array<int, 4>& face :
         {std::array{0, 1, 3, 2}, std::array{4, 6, 7, 5}, std::array{0, 4, 5, 1}, std::array{2, 3, 7, 6},
          std::array{0, 2, 6, 4}, std::array{1, 5, 7, 3}}) {
        add_triangle(scene, corner(face[0]), corner(face[1]), corner(face[2]));
        add_triangle(scene, corner(face[2]), corner(face[3]), corner(face[0]));
    }
}

void make_object(scene::Scene& scene, std::uint32_t first_triangle) {
    const auto count = static_cast<std::uint32_t>(scene.triangles.size()) - first_triangle;
    scene.objects.push_back({"object", first_triangle, count});
}

scene::Scene without_instances(const scene::Scene& scene) {
    scene::Scene flat = scene;
    const auto world_count = static_cast<std::ptrdiff_t>(scene::world_triangle_count(scene));
    flat.triangles.erase(flat.triangles.begin() + world_count, flat.triangles.end());
    flat.triangle_material.erase(flat.triangle_material.begin() + world_count, flat.triangle_material.end());
    flat.triangle_light.erase(flat.triangle_light.begin() + world_count, flat.triangle_light.end());
    flat.objects.clear();
    flat.instances.clear();
    for (const scene::Instance& instance : scene.instances) {
        const scene::Object& object = scene.objects[instance.object];
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            const std::uint32_t triangle = object.first_triangle + i;
            const auto corner = [&](int k) {
                return transformed(instance.world_from_object,
                                   scene.positions[scene.triangles[triangle].vertex[k]]);
            };
            add_triangle(flat, corner(0), corner(1), corner(2), scene.triangle_material[triangle]);
        }
    }
    return flat;
}

scene::Scene scaled(scene::Scene scene, float factor) {
    const auto scale = [&](Float3& p) { p = {factor * p.x, factor * p.y, factor * p.z}; };
    for (Float3& p : scene.positions) scale(p);
    for (scene::PolygonLight& light : scene.lights.of<scene::PolygonLight>())
        for (Float3& p : light.vertices) scale(p);
    for (scene::Instance& instance : scene.instances)
        for (const std::size_t i : {3, 7, 11}) instance.world_from_object[i] *= factor;
    return scene;
}

} // namespace nusselt::visibility_test
