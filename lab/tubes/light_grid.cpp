#include "lab/tubes/light_grid.h"

#include "lab/errors/image_errors.h"
#include "lab/tubes/rectangle.h"
#include "lab/tubes/tube_settings.h"
#include "render/film.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using render::RenderSettings;
using scene::LineLight;
using scene::TubeModel;

const std::vector<float> kRadii = {0.01f, 0.03f, 0.1f};
const std::vector<float> kDistances = {0.25f, 0.5f, 1};
const std::vector<float> kRoughnesses = {0.2f, 0.4f, 0.7f};

/// Radiance times radius of all lights [W/(sr m)].
constexpr float kBrightness = 0.04f;

/// The only light of the scene.
LineLight& light_of(scene::Scene& scene) {
    auto& lights = scene.lights.of<LineLight>();
    if (scene.lights.size() != 1 || lights.empty())
        throw std::runtime_error("the scene of a light grid must have one line alone");
    return lights[0];
}

/// Makes a rectangle of a strip. No ray hits it, as with lights without a surface.
void make_rectangle(scene::Scene& scene) {
    scene.lights.of<scene::PolygonLight>() = {rectangle_of(light_of(scene))};
    scene.lights.of<LineLight>().clear();
}

double largest_radiance(const image::Image& image) {
    return *std::max_element(image.pixels.begin(), image.pixels.end());
}

/// Renders a cell.
class CellRenderer {
public:
    CellRenderer(const LightGrid& grid, const scene::Scene& base, int threads)
        : grid_(grid), base_(base), threads_(threads) {}

    GridCell render(float radius, float distance, float roughness) const {
        GridCell cell = {radius, distance, roughness, {}, 0, {}, {}};
        const bool is_cylinder = grid_.light == GridLight::cylinder;
        const auto with = [&](TubeModel model) {
            scene::Scene scene = base_;
            scene.materials.at(0).roughness = roughness;
            LineLight& light = light_of(scene);
            const float lift = distance - light.start.y;
            light.start.y += lift;
            light.end.y += lift;
            light.radius = radius;
            light.radiance = {kBrightness / radius, kBrightness / radius, kBrightness / radius};
            light.model = model;
            return scene;
        };
        scene::Scene truth = with(is_cylinder ? TubeModel::open : TubeModel::strip);
        const scene::Scene line = with(is_cylinder ? TubeModel::linear : TubeModel::strip);
        const double radiance = static_cast<double>(kBrightness / radius);
        const auto add = [&](const scene::Scene& scene, const RenderSettings& settings) {
            cell.images.push_back(image_of(scene, settings));
            cell.errors.push_back({0, largest_radiance(cell.images.back()) / radiance});
        };
        add(line, sampled_tubes(grid_.samples));
        add(truth, analytic_tubes());
        if (is_cylinder) add(line, analytic_tubes());
        if (!is_cylinder) make_rectangle(truth);
        cell.reference = image_of(truth, sampled_tubes(grid_.samples));
        cell.largest = largest_radiance(cell.reference) / radiance;
        for (std::size_t i = 0; i < cell.images.size(); ++i)
            cell.errors[i].rmse = std::sqrt(mean_square_difference(cell.images[i], cell.reference)) /
                                  mean_radiance(cell.reference);
        return cell;
    }

private:
    image::Image image_of(const scene::Scene& scene, const RenderSettings& settings) const {
        return render_cpu::Renderer(scene, threads_).render(settings, base::choose_isa()).image;
    }

    const LightGrid& grid_;
    const scene::Scene& base_;
    int threads_;
};

} // namespace

const std::vector<LightGrid>& all_light_grids() {
    static const std::vector<LightGrid> grids = {
        {"tube-approximation", "Heitz and Hill 2017, Fig. 1.8",
         "Cylinders above metal, and the lines that approximate them, for several radii, distances and "
         "roughnesses.",
         GridLight::cylinder, kRadii, kDistances, kRoughnesses},
        {"strip-approximation", "Heitz and Hill 2017, Fig. 1.18",
         "Rectangles above metal, and the lines with a normal that approximate them.", GridLight::rectangle,
         kRadii, kDistances, kRoughnesses}};
    return grids;
}

LightGrid quick(LightGrid grid) {
    grid.width = 64;
    grid.samples = 64;
    return grid;
}

LightGridResult run_light_grid(const LightGrid& grid, const RunSettings& settings,
                               const ProgressText& progress) {
    scene::Scene scene = scene::load_scene(settings.scenes / "evidence/tube-over-metal.pbrt");
    render::resize_film_to_width(scene, grid.width);
    const CellRenderer renderer(grid, scene, thread_count(settings));
    LightGridResult result = {grid, {}, scene.files};
    for (const float distance : grid.distances)
        for (const float roughness : grid.roughnesses) {
            progress(fmt::format("distance {} m, roughness {}", distance, roughness));
            for (const float radius : grid.radii)
                result.cells.push_back(renderer.render(radius, distance, roughness));
        }
    return result;
}

} // namespace nusselt::lab
