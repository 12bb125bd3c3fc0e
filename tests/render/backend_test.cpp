// The processor as a backend.

#include "backend_contract.h"
#include "scenes.h"

#include "render_cpu/backend.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace nusselt {
namespace {

using base::Isa;
using render_cpu::CpuBackend;

scene::Scene lit_floor() {
    scene::Scene scene = render_test::make_floor(40);
    render_test::set_camera(scene, {0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.3, 40, 40);
    render_test::add_polygon_light(scene, {scene::Float3{-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}, {9, -9, 5}},
                                   {1, 1, 1}, true, 0);
    render_test::set_radius(scene);
    return scene;
}

TEST(CpuBackend, FulfilsTheContract) {
    const scene::Scene scene = lit_floor();
    for (const Isa isa : base::kAllIsas)
        if (is_supported(isa)) render_test::expect_backend_contract(CpuBackend(isa, 2), scene, {});
}

TEST(CpuBackend, RendersWhatItsRendererRenders) {
    const scene::Scene scene = lit_floor();
    const Isa isa = base::choose_isa();
    render::RenderSettings settings;
    settings.samples = 2;
    settings.layers = {render::LayerKind::albedo, render::LayerKind::depth};
    const render::RenderResult result = render::render(CpuBackend(isa, 2), scene, settings);
    const render::RenderResult expected = render_cpu::Renderer(scene, 1).render(settings, isa);
    EXPECT_EQ(result.image.pixels, expected.image.pixels);
    ASSERT_EQ(result.layers.size(), expected.layers.size());
    for (std::size_t i = 0; i < result.layers.size(); ++i)
        EXPECT_EQ(result.layers[i].data, expected.layers[i].data);
    settings.samples = 0;
    EXPECT_THROW(static_cast<void>(render::render(CpuBackend(isa, 1), scene, settings)),
                 std::invalid_argument);
}

TEST(Frame, KnowsSamplesOfPixelsThatWereStopped) {
    const scene::Scene scene = lit_floor();
    render::RenderSettings settings;
    settings.samples = 12;
    render::Frame frame = render::make_frame(scene, settings);
    std::fill(frame.rays.begin(), frame.rays.end(), 4.0f);
    EXPECT_DOUBLE_EQ(finished_fraction(frame), 1.0 / 3);
    const image::LayeredImage stopped = to_layered_image(std::move(frame), scene.film, settings, {});
    const image::Layer* const samples = image::find_layer(stopped, "samples");
    ASSERT_NE(samples, nullptr);
    for (const float value : samples->data) EXPECT_EQ(value, 4);
}

} // namespace
} // namespace nusselt
