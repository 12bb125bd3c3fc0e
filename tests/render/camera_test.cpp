/// Orthographic cameras, other sizes of the film, crops.

#include "scenes.h"

#include "render/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace nusselt::render_test {
namespace {

using scene::PixelBounds;

constexpr float kCellSize = 0.125f;

/// Luminous cells of different radiance in the plane z = 0, seen from above by parallel rays: pixel (x, y) of a film of
/// `width` times `height` pixels sees the point (x, -y) times `pixel`, from its centre.
scene::Scene make_cells(int width, int height, double pixel) {
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.materials[0].diffuse = {0, 0, 0};
    for (int j = -16; j < 16; ++j)
        for (int i = -16; i < 16; ++i) {
            const auto at = [&](int di, int dj) {
                return Float3{kCellSize * static_cast<float>(i + di), kCellSize * static_cast<float>(j + dj),
                              0};
            };
            add_polygon_light(scene, {at(0, 0), at(1, 0), at(1, 1), at(0, 1)},
                              {static_cast<float>(i + 17), static_cast<float>(j + 17), 1}, false, 0);
        }
    const auto p = static_cast<float>(pixel);
    scene.camera.origin = {-0.5f * p * static_cast<float>(width), 0.5f * p * static_cast<float>(height), 3};
    scene.camera.origin_right = {p, 0, 0};
    scene.camera.origin_down = {0, -p, 0};
    scene.camera.corner = {0, 0, -1};
    scene.camera.right = {0, 0, 0};
    scene.camera.down = {0, 0, 0};
    scene.film.width = width;
    scene.film.height = height;
    set_radius(scene);
    return scene;
}

image::Image render(const scene::Scene& scene, render::PixelPosition position,
                    base::Isa isa = base::choose_isa()) {
    render::RenderSettings settings;
    settings.samples = 2;
    settings.pixel_position = position;
    return render_cpu::Renderer(scene, 2).render(settings, isa).image;
}

/// Compares with the cell that each pixel centre lies in.
void expect_cells(const scene::Scene& scene, double pixel) {
    const PixelBounds bounds = render::rendered_pixels(scene.film);
    const image::Image image = render(scene, render::PixelPosition::center);
    ASSERT_EQ(image.width, bounds.x_end - bounds.x_begin);
    ASSERT_EQ(image.height, bounds.y_end - bounds.y_begin);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double column = pixel * (x + bounds.x_begin + 0.5 - 0.5 * scene.film.width) / kCellSize;
            const double row = -pixel * (y + bounds.y_begin + 0.5 - 0.5 * scene.film.height) / kCellSize;
            // Not where rounding decides.
            if (std::fabs(column - std::round(column)) < 1e-3 || std::fabs(row - std::round(row)) < 1e-3)
                continue;
            const std::size_t index = 3 * static_cast<std::size_t>(y * image.width + x);
            const auto cell = [](double position) { return static_cast<float>(std::floor(position) + 17); };
            const bool is_lit = std::fabs(column) < 16 && std::fabs(row) < 16;
            ASSERT_EQ(image.pixels[index], is_lit ? cell(column) : 0) << x << " " << y;
            ASSERT_EQ(image.pixels[index + 1], is_lit ? cell(row) : 0) << x << " " << y;
        }
}

TEST(Orthographic, SeesTheCellsBehindEachPixel) {
    expect_cells(make_cells(50, 40, 0.07), 0.07);
    expect_cells(make_cells(17, 33, 0.031), 0.031);
}

TEST(Orthographic, KeepsItsShorterAxisWhenTheFilmIsResized) {
    scene::Scene scene = make_cells(50, 40, 0.07);
    render::resize_film(scene, 30, 20);
    expect_cells(scene, 0.07 * 40 / 20);
    render::resize_film(scene, 25, 60);
    expect_cells(scene, 0.07 * 40 / 25);
}

/// The same for a camera with a centre of projection above the cells.
TEST(Perspective, KeepsItsShorterAxisWhenTheFilmIsResized) {
    scene::Scene scene = make_cells(50, 40, 0.07);
    scene.camera = {};
    set_camera(scene, {0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.07 * 40 / (2 * 2), 50, 40);
    expect_cells(scene, 0.07);
    render::resize_film(scene, 25, 60);
    expect_cells(scene, 0.07 * 40 / 25);
}

TEST(ResizedCrop, KeepsItsShareOfTheFilm) {
    const auto resized = [](const PixelBounds& crop, int width, int height) {
        scene::Scene scene = make_cells(100, 60, 0.01);
        scene.film.crop = crop;
        render::resize_film(scene, width, height);
        const PixelBounds result = scene.film.crop.value();
        return std::array{result.x_begin, result.x_end, result.y_begin, result.y_end};
    };
    EXPECT_EQ(resized({10, 6, 50, 60}, 200, 120), (std::array{20, 100, 12, 120}));
    EXPECT_EQ(resized({10, 6, 50, 60}, 33, 20), (std::array{3, 17, 2, 20}));
    // Neighbours stay neighbours.
    EXPECT_EQ(resized({50, 0, 100, 60}, 33, 20), (std::array{17, 33, 0, 20}));
    // At least one pixel is left.
    EXPECT_EQ(resized({99, 30, 100, 31}, 3, 3), (std::array{2, 3, 2, 3}));
    EXPECT_EQ(resized({0, 0, 1, 1}, 1, 1), (std::array{0, 1, 0, 1}));
    EXPECT_THROW(resized({0, 0, 1, 1}, 0, 1), std::invalid_argument);
}

class Crops : public testing::TestWithParam<base::Isa> {};

TEST_P(Crops, AreBitIdenticalToTheSamePixelsOfTheWholeFilm) {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this processor does not support it";
    scene::Scene scene = make_box_scene(70);
    scene.materials[0].alpha = 0.9f;
    scene.film.filter = {.kind = scene::FilterKind::mitchell, .radius_x = 2, .radius_y = 1.5f};
    render::resize_film(scene, 77, 59);
    const image::Image whole = render(scene, render::PixelPosition::jittered, GetParam());
    for (const PixelBounds& crop :
         {PixelBounds{0, 0, 77, 59}, PixelBounds{16, 16, 32, 48}, PixelBounds{3, 5, 72, 58},
          PixelBounds{41, 30, 42, 31}, PixelBounds{76, 58, 77, 59}, PixelBounds{17, 0, 19, 59}}) {
        scene.film.crop = crop;
        const image::Image image = render(scene, render::PixelPosition::jittered, GetParam());
        ASSERT_EQ(image.width, crop.x_end - crop.x_begin);
        ASSERT_EQ(image.height, crop.y_end - crop.y_begin);
        const auto row_floats = static_cast<std::ptrdiff_t>(3 * image.width);
        for (int y = 0; y < image.height; ++y) {
            const auto row = image.pixels.begin() + y * row_floats;
            const auto expected =
                whole.pixels.begin() + 3 * ((y + crop.y_begin) * whole.width + crop.x_begin);
            ASSERT_TRUE(std::equal(row, row + row_floats, expected)) << "row " << y;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllIsas, Crops, testing::ValuesIn(base::kAllIsas),
                         [](const auto& test) { return std::string(name_of(test.param)); });

} // namespace
} // namespace nusselt::render_test
