#include "lights/sky_scenes.h"

#include "base/isa.h"
#include "render_cpu/renderer.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

namespace nusselt::render_test {

scene::Double3 square_direction(double x, double y) {
    const double u = 2 * x - 1;
    const double v = 2 * y - 1;
    const double d = 1 - std::fabs(u) - std::fabs(v);
    const double r = 1 - std::fabs(d);
    const double angle = r == 0 ? 0 : std::numbers::pi / 4 * ((std::fabs(v) - std::fabs(u)) / r + 1);
    const double across = r * std::sqrt(2 - r * r);
    return {std::copysign(across * std::cos(angle), u), std::copysign(across * std::sin(angle), v),
            std::copysign(1 - r * r, d)};
}

void set_mean(scene::EnvironmentMapTexels& map) {
    scene::Double3 sum;
    for (const scene::Float3& texel : map.texels) sum = sum + scene::to_double(texel);
    map.mean = scene::to_float((1 / static_cast<double>(map.texels.size())) * sum);
}

void add_sky(scene::Scene& scene, scene::EnvironmentLight light, const scene::EnvironmentMapTexels* map) {
    light.emitter = static_cast<std::uint32_t>(scene.emitters.size());
    scene.emitters.push_back({"sky"});
    if (map != nullptr) {
        light.map = static_cast<std::int32_t>(scene.environment_maps.size());
        light.radiance = map->mean;
        scene.environment_maps.push_back(std::make_shared<const scene::EnvironmentMapTexels>(*map));
    }
    scene.lights.of<scene::EnvironmentLight>().push_back(light);
}

render::RenderSettings centred(int samples) {
    render::RenderSettings settings;
    settings.pixel_position = render::PixelPosition::center;
    settings.sample_order = render::SampleOrder::independent;
    settings.samples = samples;
    settings.camera_rays = 1;
    return settings;
}

PixelMean render_green(const scene::Scene& scene, const render::RenderSettings& settings) {
    const image::Image image = render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
    std::vector<double> values;
    for (std::size_t i = 1; i < image.pixels.size(); i += 3) values.push_back(image.pixels[i]);
    PixelMean mean;
    const auto count = static_cast<double>(values.size());
    for (const double value : values) mean.value += value / count;
    for (const double value : values)
        mean.deviation += (value - mean.value) * (value - mean.value) / (count - 1);
    mean.deviation = std::sqrt(mean.deviation);
    mean.error = mean.deviation / std::sqrt(count);
    return mean;
}

bool agree(const PixelMean& a, const PixelMean& b) {
    return std::fabs(a.value - b.value) <= 5 * std::hypot(a.error, b.error);
}

} // namespace nusselt::render_test
