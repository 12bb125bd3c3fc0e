#include "render_cpu/kernel_arrays.h"

#include "render/film.h"
#include "render/instance_transform.h"
#include "render_cpu/lights/float_count.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace nusselt::render_cpu {

namespace {

MaterialRow make_row(const scene::Material& material) {
    return {{material.diffuse.x, material.diffuse.y, material.diffuse.z},
            {material.f0.x, material.f0.y, material.f0.z},
            material.roughness,
            material.exponent,
            static_cast<float>(material.model)};
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

KernelArrays::KernelArrays(const scene::Scene& scene, std::span<const LightKernel> kernels)
    : scene_(scene),
      filter_x_(make_filter_table(scene.film.filter, scene.film.filter.radius_x)),
      filter_y_(make_filter_table(scene.film.filter, scene.film.filter.radius_y)) {
    check_float_count(3 * scene.positions.size(), "vertices");
    check_float_count(sizeof(MaterialTextures) / sizeof(float) * scene.materials.size(), "materials");
    for (const scene::Material& material : scene.materials) {
        materials_.push_back(make_row(material));
        lambert_materials_.push_back(materials_.back());
        lambert_materials_.back().model = static_cast<float>(scene::BrdfModel::lambert);
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
    for (const scene::LightList& list : scene.lights) add_lights(list, kernels);
    check_float_count(sizeof(InstanceRecord) / sizeof(float) * scene.instances.size(), "instances");
    for (const scene::Instance& instance : scene.instances)
        instances_.push_back(make_record(scene, instance));
    light_emitter_ = scene::light_emitters(scene);
}

void KernelArrays::add_lights(const scene::LightList& list, std::span<const LightKernel> kernels) {
    const std::int32_t first = light_sets_.empty() ? 0 : light_sets_.back().first + light_sets_.back().count;
    for (const LightKernel& kernel : kernels) {
        std::shared_ptr<const void> records = kernel.make_records(scene_, list);
        if (records == nullptr) continue;
        light_sets_.push_back({std::move(records), &kernel, first, static_cast<std::int32_t>(list.size())});
        return;
    }
    if (list.size() > 0)
        throw std::runtime_error("the CPU renderer does not support " + std::string(list.name()) + " lights");
}

std::vector<LightSet> KernelArrays::light_sets(base::Isa isa) const {
    std::vector<LightSet> sets;
    for (const Lights& lights : light_sets_)
        sets.push_back({lights.records.get(),
                        lights.first,
                        lights.count,
                        lights.kernel->code[static_cast<std::size_t>(isa)],
                        {}});
    return sets;
}

bool KernelArrays::take_lines() const {
    return std::any_of(light_sets_.begin(), light_sets_.end(),
                       [](const Lights& lights) { return lights.count > 0 && lights.kernel->takes_lines; });
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
    view.light_count = static_cast<std::int32_t>(light_emitter_.size());
    view.light_emitter = light_emitter_.data();
    view.emitter_count = static_cast<std::uint32_t>(scene_.emitters.size());
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
