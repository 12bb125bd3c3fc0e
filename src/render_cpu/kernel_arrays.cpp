#include "render_cpu/kernel_arrays.h"

#include "render/film.h"
#include "render/instance_transform.h"

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace nusselt::render_cpu {

namespace {

constexpr std::size_t kMaxFloats = std::numeric_limits<std::int32_t>::max();

void check_float_count(std::size_t count, const std::string& what) {
    if (count > kMaxFloats)
        throw std::runtime_error(what + ": " + std::to_string(count) + " numbers are more than the " +
                                 std::to_string(kMaxFloats) + " that can be addressed");
}

Vec3<float> to_vec(const scene::Float3& v) { return {v.x, v.y, v.z}; }
scene::Float3 to_float3(const Vec3<float>& v) { return {v.x, v.y, v.z}; }
scene::Float3 times(float factor, const scene::Float3& v) {
    return {factor * v.x, factor * v.y, factor * v.z};
}

MaterialRow make_row(const scene::Material& material) {
    return {{material.diffuse.x, material.diffuse.y, material.diffuse.z},
            {material.f0.x, material.f0.y, material.f0.z},
            material.roughness,
            material.model == scene::BrdfModel::frostbite ? 1.0f : 0.0f};
}

std::uint32_t texture_kinds(const MaterialTextures& textures) {
    const std::pair<const scene::TextureUse&, TextureKind> uses[] = {{textures.diffuse, kDiffuseTexture},
                                                                     {textures.f0, kF0Texture},
                                                                     {textures.roughness, kRoughnessTexture},
                                                                     {textures.normal, kNormalTexture},
                                                                     {textures.bump, kBumpTexture}};
    std::uint32_t kinds = 0;
    for (const auto& [use, kind] : uses)
        if (use.texture >= 0) kinds |= kind;
    return kinds;
}

/// How many vertices the kernel's form of a polygon has room for.
std::int32_t slots_of(const scene::PolygonLight& light) { return light.vertices.size() <= 4 ? 4 : 8; }

template <int N>
void add_polygon(const scene::PolygonVertices& vertices, PolygonLightRecord& record,
                 std::vector<scene::Float3>& all_corners) {
    Vec3<float> corners[N];
    for (std::size_t j = 0; j < vertices.size(); ++j) corners[j] = to_vec(vertices[j]);
    const auto polygon = make_polygon<N>(corners, static_cast<int>(vertices.size()));
    record.first_corner = static_cast<std::uint32_t>(all_corners.size());
    for (int j = 0; j < N; ++j) all_corners.push_back(to_float3(polygon.vertex[j]));
    for (int j = 0; j < N; ++j) all_corners.push_back(to_float3(polygon.edge[j]));
    record.normal = to_float3(polygon.normal);
}

PolygonLightRecord make_record(const scene::Scene& scene, const scene::PolygonLight& light,
                               std::vector<scene::Float3>& all_corners) {
    const std::size_t count = light.vertices.size();
    if (count < 3)
        throw std::runtime_error("light " + scene.emitters[light.emitter].name +
                                 ": polygonal lights have at least 3 vertices, not " + std::to_string(count));
    PolygonLightRecord record{};
    record.slots = slots_of(light);
    if (record.slots == 4)
        add_polygon<4>(light.vertices, record, all_corners);
    else
        add_polygon<8>(light.vertices, record, all_corners);
    record.radiance = light.radiance;
    record.two_sided = light.two_sided ? 1 : 0;
    return record;
}

LineLightRecord make_record(const scene::LineLight& light) {
    const auto line = make_line(to_vec(light.start), to_vec(light.end));
    return {to_float3(line.p0),
            to_float3(line.s),
            line.length,
            light.radius,
            light.model,
            light.radiance,
            times(light.radius, light.radiance)};
}

InstanceRecord make_record(const scene::Scene& scene, const scene::Instance& instance) {
    const InstanceTransform transform = make_instance_transform(scene, instance);
    InstanceRecord record{};
    const auto& m = instance.world_from_object;
    std::copy(m.begin(), m.end(), record.world_from_object);
    const auto& normal = transform.normal_from_object;
    std::copy(normal.begin(), normal.end(), record.normal_from_object);
    record.handedness = transform.handedness;
    record.rounding = transform.rounding;
    return record;
}

FilterAxis view_of(const PixelFilterTable& table, float radius) {
    if (table.cumulative.empty()) return {radius, nullptr, nullptr};
    return {table.reach, table.cumulative.data(), table.weights.data()};
}

} // namespace

KernelArrays::KernelArrays(const scene::Scene& scene)
    : scene_(scene),
      filter_x_(make_filter_table(scene.film.filter, scene.film.filter.radius_x)),
      filter_y_(make_filter_table(scene.film.filter, scene.film.filter.radius_y)) {
    check_float_count(3 * scene.positions.size(), "vertices");
    check_float_count(sizeof(MaterialTextures) / sizeof(float) * scene.materials.size(), "materials");
    for (const scene::Material& material : scene.materials) {
        materials_.push_back(make_row(material));
        lambert_materials_.push_back(materials_.back());
        lambert_materials_.back().is_frostbite = 0;
        const float is_bump_in_uv = material.bump_unit == scene::BumpUnit::texture_coordinate ? 1.0f : 0.0f;
        material_textures_.push_back({material.diffuse_texture, material.f0_texture,
                                      material.roughness_texture, material.normal_texture,
                                      material.bump_texture, material.bump, is_bump_in_uv});
        material_texture_kinds_.push_back(texture_kinds(material_textures_.back()));
    }
    for (const scene::Texture& texture : scene.textures) {
        check_float_count(texture.texels.size(), "texture " + texture.name);
        textures_.push_back({texture.texels.data(), texture.width, texture.height, texture.channels,
                             texture.wrap, texture.filter});
    }
    std::size_t corners = 0;
    for (const scene::PolygonLight& light : scene.polygon_lights)
        corners += 2 * static_cast<std::size_t>(slots_of(light));
    check_float_count(3 * corners, "lights");
    polygon_corners_.reserve(corners);
    polygon_lights_.reserve(scene.polygon_lights.size());
    for (const scene::PolygonLight& light : scene.polygon_lights)
        polygon_lights_.push_back(make_record(scene, light, polygon_corners_));
    for (const scene::LineLight& light : scene.line_lights) line_lights_.push_back(make_record(light));
    check_float_count(sizeof(InstanceRecord) / sizeof(float) * scene.instances.size(), "instances");
    for (const scene::Instance& instance : scene.instances)
        instances_.push_back(make_record(scene, instance));
    for (const scene::PolygonLight& light : scene.polygon_lights) light_emitter_.push_back(light.emitter);
    for (const scene::LineLight& light : scene.line_lights) light_emitter_.push_back(light.emitter);
}

KernelScene KernelArrays::view(BrdfChoice brdf) const {
    KernelScene view{};
    view.positions = scene_.positions.data();
    view.normals = scene_.normals.data();
    view.uvs = scene_.uvs.data();
    view.triangles = scene_.triangles.data();
    view.triangle_material = scene_.triangle_material.data();
    view.triangle_light = scene_.triangle_light.data();
    view.materials = (brdf == BrdfChoice::lambert ? lambert_materials_ : materials_).data();
    view.material_texture_kinds = material_texture_kinds_.data();
    view.material_textures = material_textures_.data();
    view.textures = textures_.data();
    view.polygon_lights = polygon_lights_.data();
    view.polygon_corners = polygon_corners_.data();
    view.line_lights = line_lights_.data();
    view.light_emitter = light_emitter_.data();
    view.emitter_count = static_cast<std::uint32_t>(scene_.emitters.size());
    view.polygon_light_count = static_cast<std::int32_t>(polygon_lights_.size());
    view.line_light_count = static_cast<std::int32_t>(line_lights_.size());
    view.instances = instances_.empty() ? nullptr : instances_.data();
    view.camera = scene_.camera;
    view.filter_x = view_of(filter_x_, scene_.film.filter.radius_x);
    view.filter_y = view_of(filter_y_, scene_.film.filter.radius_y);
    view.film_width = scene_.film.width;
    view.film_height = scene_.film.height;
    view.radius = static_cast<float>(scene_.radius);
    return view;
}

} // namespace nusselt::render_cpu
