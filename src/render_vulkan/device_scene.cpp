#include "render_vulkan/device_scene.h"

#include "render_vulkan/record_values.h"
#include "tables/blue_noise.h"
#include "tables/ltc_table.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace nusselt::render_vulkan {

namespace {

SceneRecords make_records(const scene::Scene& scene) {
    SceneRecords records = make_scene_records(scene);
    const auto copy_samples = [](const tables::LtcTable& table, int* to) {
        const int samples[] = {table.f0s, table.inclinations, table.roughnesses};
        std::copy(std::begin(samples), std::end(samples), to);
    };
    copy_samples(tables::frostbite_ltc_table(), records.scene.frostbite_lobe_samples);
    copy_samples(tables::phong_ltc_table(), records.scene.phong_lobe_samples);
    return records;
}

/// The entries of the table of the Frostbite BRDF, then those of Phong lobes.
std::vector<float> all_lobes() {
    std::vector<float> all = tables::frostbite_ltc_table().entries;
    const std::vector<float>& phong = tables::phong_ltc_table().entries;
    all.insert(all.end(), phong.begin(), phong.end());
    return all;
}

} // namespace

DeviceScene::DeviceScene(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays,
                         std::optional<TextureAccess> textures)
    : DeviceScene(device, scene, shadow_rays, textures, make_records(scene)) {}

DeviceScene::DeviceScene(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays,
                         std::optional<TextureAccess> textures, const SceneRecords& records)
    : device_(device),
      film_(scene.film),
      radius_(scene.radius),
      record_(records.scene),
      drawn_triangles_(records.drawn_triangles),
      polygon_slots_(records.lights.polygon_slots),
      light_count_(checked_count(scene.lights.size(), "lights")),
      kinds_(records.kinds),
      buffers_(device, records),
      textures_(device, scene.textures, textures),
      ltc_table_(upload(device, std::span<const float>(all_lobes()), "lobes")),
      blue_noise_(upload(device, std::span(tables::blue_noise().bytes, BlueNoiseView::kBytes), "blue noise")),
      shadows_(device, scene, shadow_rays) {}

void DeviceScene::set_view(const scene::Camera& camera, const scene::Film& film) {
    film_ = film;
    render_vulkan::set_camera(camera, film_, radius_, record_);
    buffers_.scene.write(std::span<const interface::SceneRecord>(&record_, 1));
}

} // namespace nusselt::render_vulkan
