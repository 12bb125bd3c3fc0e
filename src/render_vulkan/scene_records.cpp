#include "render_vulkan/scene_records.h"

#include "render/film.h"
#include "render/instance_transform.h"
#include "render_vulkan/record_values.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/scene_size.h"
#include "scene/model/vector_math.h"
#include "visibility/alpha.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace nusselt::render_vulkan {

namespace {

using scene::Double3;

void add_vertices(const scene::Scene& scene, const scene::LightMesh& lights, SceneRecords& records) {
    records.vertices.reserve(scene.positions.size() + lights.positions.size());
    const auto add = [&](const scene::Float3& position, const scene::Float3& normal,
                         const scene::Float2& uv) {
        interface::VertexRecord& record = records.vertices.emplace_back();
        copy(position, record.position);
        copy(normal, record.normal);
        record.uv[0] = uv.x;
        record.uv[1] = uv.y;
    };
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
        add(scene.positions[i], scene.normals[i], scene.uvs[i]);
    for (const scene::Float3& position : lights.positions) add(position, {0, 0, 0}, {0, 0});
}

void add_triangles(const scene::Scene& scene, const scene::LightMesh& lights, SceneRecords& records) {
    records.triangles.reserve(scene.triangles.size() + lights.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const auto& vertex = scene.triangles[i].vertex;
        records.triangles.push_back(
            {{vertex[0], vertex[1], vertex[2]}, scene.triangle_material[i], scene.triangle_light[i]});
    }
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (std::size_t i = 0; i < lights.triangles.size(); ++i) {
        const auto& vertex = lights.triangles[i].vertex;
        records.triangles.push_back({{first + vertex[0], first + vertex[1], first + vertex[2]},
                                     0,
                                     static_cast<std::int32_t>(lights.lights[i])});
    }
}

/// \returns how many triangles the world and all instances have
std::uint64_t add_instances(const scene::Scene& scene, SceneRecords& records) {
    std::uint64_t drawn = world_triangle_count(scene);
    for (const scene::Instance& instance : scene.instances) {
        const scene::Object& object = scene.objects[instance.object];
        const render::InstanceTransform transform = render::make_instance_transform(scene, instance);
        interface::InstanceRecord& record = records.instances.emplace_back();
        record.first_drawn = checked_count(3 * drawn, "corners of triangles") / 3;
        record.first_triangle = object.first_triangle;
        std::copy(instance.world_from_object.begin(), instance.world_from_object.end(),
                  record.world_from_object);
        std::copy(transform.normal_from_object.begin(), transform.normal_from_object.end(),
                  record.normal_from_object);
        record.handedness = transform.handedness;
        record.rounding = transform.rounding;
        drawn += object.triangle_count;
    }
    return drawn;
}

interface::TextureLookup make_lookup(const scene::TextureUse& use, std::uint32_t kind, std::uint32_t& kinds) {
    if (use.texture < 0) return {interface::kNoTexture, {}, {}};
    kinds |= kind;
    return {
        static_cast<std::uint32_t>(use.texture), {use.scale.x, use.scale.y}, {use.offset.x, use.offset.y}};
}

static_assert(static_cast<std::uint32_t>(scene::BrdfModel::lambert) == interface::kModelLambert &&
              static_cast<std::uint32_t>(scene::BrdfModel::frostbite) == interface::kModelFrostbite &&
              static_cast<std::uint32_t>(scene::BrdfModel::phong) == interface::kModelPhong);

interface::MaterialRecord make_record(const scene::Material& material) {
    interface::MaterialRecord record {};
    copy(material.diffuse, record.diffuse);
    copy(material.f0, record.f0);
    record.roughness = material.roughness;
    record.alpha = material.alpha;
    record.exponent = material.exponent;
    record.model = static_cast<std::uint32_t>(material.model);
    std::uint32_t& kinds = record.texture_kinds;
    record.diffuse_texture = make_lookup(material.diffuse_texture, interface::kDiffuseTexture, kinds);
    record.f0_texture = make_lookup(material.f0_texture, interface::kF0Texture, kinds);
    record.roughness_texture = make_lookup(material.roughness_texture, interface::kRoughnessTexture, kinds);
    record.normal_texture = make_lookup(material.normal_texture, interface::kNormalTexture, kinds);
    record.bump_texture = make_lookup(material.bump_texture, interface::kBumpTexture, kinds);
    record.alpha_texture = make_lookup(material.alpha_texture, interface::kAlphaTexture, kinds);
    record.bump_height = material.bump;
    record.is_bump_in_uv = material.bump_unit == scene::BumpUnit::texture_coordinate ? 1 : 0;
    return record;
}

/// An affine function of three coordinates.
struct Row {
    Double3 linear;
    double constant = 0;
};

Row times(double factor, const Row& row) { return {factor * row.linear, factor * row.constant}; }
Row operator-(const Row& a, const Row& b) { return {a.linear - b.linear, a.constant - b.constant}; }

void copy(const Row& row, float* to) {
    const scene::Float3 linear = to_float(row.linear);
    to[0] = linear.x;
    to[1] = linear.y;
    to[2] = linear.z;
    to[3] = static_cast<float>(row.constant);
}

/// The rows of the inverse of the matrix with these columns.
std::array<Row, 3> inverse_rows(const Double3& a, const Double3& b, const Double3& c) {
    const double inverse = 1 / dot(a, cross(b, c));
    return {Row{inverse * cross(b, c)}, Row{inverse * cross(c, a)}, Row{inverse * cross(a, b)}};
}

} // namespace

void set_camera(const scene::Camera& camera, const scene::Film& film, double radius,
                interface::SceneRecord& record) {
    copy(camera.origin, record.origin);
    copy(camera.origin_right, record.origin_right);
    copy(camera.origin_down, record.origin_down);
    copy(camera.corner, record.corner);
    copy(camera.right, record.right);
    copy(camera.down, record.down);
    const scene::PixelBounds pixels = render::rendered_pixels(film);
    record.x_begin = pixels.x_begin;
    record.y_begin = pixels.y_begin;
    record.width = pixels.x_end - pixels.x_begin;
    record.height = pixels.y_end - pixels.y_begin;

    // Relative to the origin, a point is t (corner + x right + y down) for a perspective camera, and
    // x origin_right + y origin_down + t corner for an orthographic one.
    const bool is_perspective = length(to_double(camera.origin_right)) == 0;
    std::array<Row, 3> raster =
        is_perspective
            ? inverse_rows(to_double(camera.right), to_double(camera.down), to_double(camera.corner))
            : inverse_rows(to_double(camera.origin_right), to_double(camera.origin_down),
                           to_double(camera.corner));
    const Row w = is_perspective ? raster[2] : Row{{}, 1};
    // From pixels of the film to the square from -1 to 1.
    const Row x = times(2.0 / record.width, raster[0] - times(record.x_begin, w)) - w;
    const Row y = times(2.0 / record.height, raster[1] - times(record.y_begin, w)) - w;
    copy(x, record.clip_from_world);
    copy(y, record.clip_from_world + 4);
    copy(w, record.clip_from_world + 8);
    copy(raster[2], record.distance_from_world);
    // Beyond this fraction of the scene's size, depth has the relative accuracy of single precision.
    constexpr double kDepthUnit = 1e-2;
    const double unit = kDepthUnit * radius / length(to_double(camera.corner));
    record.inverse_depth_unit = unit > 0 ? static_cast<float>(1 / unit) : 1;
}

std::vector<std::uint32_t> constants_of(const SceneKinds& kinds) {
    std::vector<std::uint32_t> constants(interface::kConstantCount);
    const auto set = [&](int number, std::uint32_t value) {
        constants[static_cast<std::size_t>(number)] = value;
    };
    set(interface::kInstancesConstant, kinds.instances ? 1 : 0);
    set(interface::kPartialConstant, kinds.partial ? 1 : 0);
    set(interface::kFrostbiteConstant, kinds.frostbite ? 1 : 0);
    set(interface::kPhongConstant, kinds.phong ? 1 : 0);
    set(interface::kTextureKindsConstant, kinds.textures);
    std::copy(kinds.lights.begin(), kinds.lights.end(), constants.begin() + interface::kFirstLightConstant);
    return constants;
}

SceneRecords make_scene_records(const scene::Scene& scene) {
    const scene::LightMesh lights = make_light_mesh(scene);
    checked_count(scene.positions.size() + lights.positions.size(), "vertices");
    checked_count(3 * (scene.triangles.size() + lights.triangles.size()), "corners of triangles");
    SceneRecords records{};
    add_vertices(scene, lights, records);
    add_triangles(scene, lights, records);
    const std::uint64_t first_light = add_instances(scene, records);
    const std::uint64_t first_round = first_light + lights.triangles.size();
    const std::uint64_t drawn =
        first_round + interface::kRoundBoxTriangles * scene.lights.of<scene::RoundLight>().size();
    records.drawn_triangles = checked_count(3 * drawn, "corners of triangles") / 3;
    for (const scene::Material& material : scene.materials) {
        records.materials.push_back(make_record(material));
        records.kinds.partial |= visibility::presence_of(material) != visibility::Presence::full;
        records.kinds.frostbite |= material.model == scene::BrdfModel::frostbite;
        records.kinds.phong |= material.model == scene::BrdfModel::phong;
        records.kinds.textures |= records.materials.back().texture_kinds;
    }
    records.lights = make_light_records(scene);
    records.kinds.lights = records.lights.has_shape;
    records.kinds.instances = !scene.instances.empty();

    interface::SceneRecord& record = records.scene;
    set_camera(scene.camera, scene.film, scene.radius, record);
    record.radius = static_cast<float>(scene.radius);
    record.world_triangles = static_cast<std::uint32_t>(world_triangle_count(scene));
    record.instances = static_cast<std::uint32_t>(scene.instances.size());
    record.first_light_drawn = static_cast<std::uint32_t>(first_light);
    record.first_light_triangle = static_cast<std::uint32_t>(scene.triangles.size());
    record.first_round_drawn = static_cast<std::uint32_t>(first_round);
    std::copy(records.lights.ranges.begin(), records.lights.ranges.end(), record.lights);
    return records;
}

} // namespace nusselt::render_vulkan
