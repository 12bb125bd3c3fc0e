#include "line_scenes.h"

#include <random>

namespace nusselt::render_test {

using render::RenderSettings;

RenderSettings line_settings(int lines) {
    RenderSettings settings;
    settings.light_samples = render::LightSamples::lines;
    settings.lines.count = lines;
    settings.lines.many_occluders = render::ManyOccluders::lines;
    // Seeds of render_region_means() depend on it: references have another one.
    settings.technique = render::Technique::solid_angle;
    settings.pixel_position = render::PixelPosition::center;
    settings.samples = kSamples;
    settings.camera_rays = 1;
    return settings;
}

RenderSettings point_settings() {
    RenderSettings settings = line_settings(1);
    settings.light_samples = render::LightSamples::points;
    settings.technique = render::Technique::projected_solid_angle;
    return settings;
}

scene::Scene make_soup(int triangles, int size) {
    scene::Scene scene = make_floor(size);
    scene.materials.push_back({.name = "black", .diffuse = {0, 0, 0}});
    add_polygon_light(
        scene,
        {Float3{-0.5f, -0.5f, 1}, Float3{-0.5f, 0.5f, 1}, Float3{0.5f, 0.5f, 1}, Float3{0.5f, -0.5f, 1}},
        {5, 5, 5}, false, 0);
    std::mt19937 generator(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (int i = 0; i < triangles; ++i) {
        const Float3 p{0.6f * uniform(generator), 0.6f * uniform(generator),
                       0.5f + 0.1f * uniform(generator)};
        const auto near = [&] {
            return Float3{p.x + 0.05f * uniform(generator), p.y + 0.05f * uniform(generator),
                          p.z + 0.05f * uniform(generator)};
        };
        const Float3 q = near();
        const Float3 r = near();
        add_quad(scene, {p, q, r, r}, 1);
    }
    return scene;
}

} // namespace nusselt::render_test
