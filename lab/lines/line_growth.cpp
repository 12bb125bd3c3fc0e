#include "lab/lines/line_growth.h"

#include "proof/hostile/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace nusselt::lab {

namespace {

using hostile::RandomSource;
using scene::Float3;

/// Triangles around keep out of this box, which has the floor, the light and the camera.
constexpr Float3 kLow = {-1.3f, -1.5f, -0.2f};
constexpr Float3 kHigh = {1.3f, 1.3f, 1.3f};
/// All of them are between minus and plus this [m].
constexpr double kReach = 6;
constexpr double kOccluderSize = 0.03;

void add_triangle(scene::Scene& scene, const std::array<Float3, 3>& corners, std::int32_t light) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const Float3& corner : corners) {
        scene.positions.push_back(corner);
        scene.normals.push_back({0, 0, 0});
        scene.uvs.push_back({0, 0});
    }
    scene.triangles.push_back({{first, first + 1, first + 2}});
    scene.triangle_material.push_back(0);
    scene.triangle_light.push_back(light);
}

void add_quad(scene::Scene& scene, const std::array<Float3, 4>& corners, std::int32_t light) {
    add_triangle(scene, {corners[0], corners[1], corners[2]}, light);
    add_triangle(scene, {corners[0], corners[2], corners[3]}, light);
}

void add_small_triangle(scene::Scene& scene, const std::array<double, 3>& centre, double size,
                        RandomSource& random) {
    std::array<Float3, 3> corners;
    for (Float3& corner : corners) {
        const Vec3<double> away = size * random.direction();
        corner = {static_cast<float>(centre[0] + away.x), static_cast<float>(centre[1] + away.y),
                  static_cast<float>(centre[2] + away.z)};
    }
    add_triangle(scene, corners, -1);
}

bool is_inside(const std::array<double, 3>& p, double margin) {
    const std::array<double, 3> low = {double{kLow.x}, double{kLow.y}, double{kLow.z}};
    const std::array<double, 3> high = {double{kHigh.x}, double{kHigh.y}, double{kHigh.z}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (p[axis] < low[axis] - margin || p[axis] > high[axis] + margin) return false;
    return true;
}

/// A floor that fills the image, a square light above it, triangles in between, and triangles around.
scene::Scene make_scene(const GrowthSize& size, int width) {
    scene::Scene scene;
    scene.materials.push_back({.name = "grey"});
    add_quad(scene, {Float3{-1, -1, 0}, Float3{1, -1, 0}, Float3{1, 1, 0}, Float3{-1, 1, 0}}, -1);
    const std::array<Float3, 4> light = {Float3{-0.3f, -0.3f, 1}, Float3{-0.3f, 0.3f, 1},
                                         Float3{0.3f, 0.3f, 1}, Float3{0.3f, -0.3f, 1}};
    scene::PolygonLight polygon;
    scene.emitters.push_back({"light"});
    polygon.vertices.assign(light.begin(), light.end());
    polygon.radiance = {1, 1, 1};
    scene.lights.of<scene::PolygonLight>().push_back(polygon);
    add_quad(scene, light, 0);

    RandomSource random(1, 0);
    for (int i = 0; i < size.occluders; ++i)
        add_small_triangle(scene,
                           {random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(0.35, 0.65)},
                           kOccluderSize, random);
    // Triangles around have the size that lets them touch: they are the more crowded the more there are.
    const double around_size = kReach / std::cbrt(static_cast<double>(size.around));
    for (int i = 0; i < size.around;) {
        const std::array<double, 3> centre = {random.between(-kReach, kReach),
                                              random.between(-kReach, kReach),
                                              random.between(-kReach, kReach)};
        if (is_inside(centre, around_size)) continue;
        add_small_triangle(scene, centre, around_size, random);
        ++i;
    }

    // Orthographic, from above: rays start below the light.
    const float pixel = 1.6f / static_cast<float>(width);
    scene.camera = {.origin = {-0.8f, 0.8f, 0.3f},
                    .origin_right = {pixel, 0, 0},
                    .origin_down = {0, -pixel, 0},
                    .corner = {0, 0, -1},
                    .right = {0, 0, 0},
                    .down = {0, 0, 0}};
    scene.film.width = width;
    scene.film.height = width;
    scene.radius = std::sqrt(3.0) * kReach;
    return scene;
}

GrowthRow measure(const LineGrowth& experiment, const GrowthSize& size, int threads) {
    const scene::Scene scene = make_scene(size, experiment.width);
    const render_cpu::Renderer renderer(scene, threads);
    const render::LineStatistics together =
        renderer.render(settings_of_lines_together(experiment.lines), base::choose_isa()).statistics.lines;
    LineByLineWork one_by_one;
    for (const LineByLineWork& work :
         trace_line_by_line(scene, line_points(scene, renderer, 1), experiment.lines, threads))
        one_by_one += work;
    const auto per_line = [&](auto count) {
        return static_cast<double>(count) /
               static_cast<double>(std::max<std::uint64_t>(one_by_one.counts.lines, 1));
    };
    const auto per_line_together = [&](auto count) {
        return static_cast<double>(count) / static_cast<double>(std::max<std::uint64_t>(together.lines, 1));
    };
    return {size,
            per_line(one_by_one.counts.box_tests),
            per_line(one_by_one.counts.triangle_tests),
            one_by_one.seconds_per_line(),
            per_line_together(together.box_tests),
            per_line_together(together.triangle_tests),
            per_line_together(together.visibility_seconds)};
}

/// How much faster than stated work may grow before an expectation fails.
constexpr double kMostGrowth = 1.2;

bool tests_fewer_boxes_together(const GrowthRow& row) { return row.box_tests_together < row.box_tests; }

std::string number(double x) { return fmt::format("{:.4g}", x); }

Table table_of(const std::string& heading, const std::vector<GrowthRow>& rows, int GrowthSize::*varied) {
    Table table = {{heading, "boxes per line, one by one", "triangles, one by one", "one by one [us]",
                    "boxes, together", "triangles, together", "together [us]"}};
    for (const GrowthRow& row : rows)
        table.push_back({fmt::format("{}", row.size.*varied), number(row.box_tests),
                         number(row.triangle_tests), number(1e6 * row.seconds),
                         number(row.box_tests_together), number(row.triangle_tests_together),
                         number(1e6 * row.seconds_together)});
    return table;
}

ResultTable numbers_of(const std::string& name, const std::vector<GrowthRow>& rows) {
    ResultTable table = {name,
                         {{"around"},
                          {"occluders"},
                          {"box_tests"},
                          {"triangle_tests"},
                          {"seconds", "s"},
                          {"box_tests_together"},
                          {"triangle_tests_together"},
                          {"seconds_together", "s"}}};
    for (const GrowthRow& row : rows)
        table.rows.push_back({row.size.around, row.size.occluders, row.box_tests, row.triangle_tests,
                              row.seconds, row.box_tests_together, row.triangle_tests_together,
                              row.seconds_together});
    return table;
}

Plot plot_of(const std::string& title, const std::string& file, const std::string& x_label,
             const std::vector<GrowthRow>& rows, int GrowthSize::*varied) {
    Plot plot = {title, file, x_label, "tests per line", {}};
    const auto add = [&](const std::string& label, double GrowthRow::*value, Stroke stroke) {
        PlotCurve curve = {label, {}, stroke};
        for (const GrowthRow& row : rows) {
            const double y = row.*value;
            curve.points.push_back({static_cast<double>(row.size.*varied), y, y, y});
        }
        plot.curves.push_back(std::move(curve));
    };
    add("boxes, one by one", &GrowthRow::box_tests, Stroke::solid);
    add("triangles, one by one", &GrowthRow::triangle_tests, Stroke::solid);
    add("boxes, together", &GrowthRow::box_tests_together, Stroke::dashed);
    add("triangles, together", &GrowthRow::triangle_tests_together, Stroke::dashed);
    return plot;
}

} // namespace

const std::vector<LineGrowth>& all_line_growths() {
    static const std::vector<LineGrowth> experiments = {
        {"lines-growth",
         "Billen and Dutre 2016, Sec. 5.2",
         "Tests of boxes and triangles per line, over the number of triangles around the space between floor "
         "and light, "
         "and over the number of triangles in it.",
         {1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20},
         {64, 256, 1024, 4096},
         64,
         48}};
    return experiments;
}

LineGrowth quick(LineGrowth experiment) {
    experiment.around = {1 << 10, 1 << 12, 1 << 14};
    experiment.occluders = {64, 256, 1024};
    experiment.lines = 16;
    experiment.width = 24;
    return experiment;
}

LineGrowthResult run_line_growth(const LineGrowth& experiment, const RunSettings& settings,
                                 const ProgressText& progress) {
    LineGrowthResult result;
    result.experiment = &experiment;
    const int threads = thread_count(settings);
    const auto run = [&](int around, int occluders, std::vector<GrowthRow>& rows) {
        progress(fmt::format("{} triangles around {} occluders", around, occluders));
        rows.push_back(measure(experiment, {around, occluders}, threads));
    };
    for (const int around : experiment.around) run(around, experiment.occluders.front(), result.by_around);
    for (const int occluders : experiment.occluders)
        run(experiment.around.front(), occluders, result.by_occluders);
    result.expectations = check_expectations(result.by_around, result.by_occluders);
    return result;
}

std::vector<ExpectationResult> check_expectations(const std::vector<GrowthRow>& by_around,
                                                  const std::vector<GrowthRow>& by_occluders) {
    const GrowthRow& few = by_around.front();
    const GrowthRow& many = by_around.back();
    const double logarithms = std::log(many.size.around) / std::log(few.size.around);
    const GrowthRow& sparse = by_occluders.front();
    const GrowthRow& dense = by_occluders.back();
    const double ratio = static_cast<double>(dense.size.occluders) / sparse.size.occluders;
    return {
        checked(
            fmt::format("one by one, tests of boxes grow at most {:g} times as much as the logarithm of the "
                        "number of triangles around",
                        kMostGrowth),
            many.box_tests <= kMostGrowth * logarithms * few.box_tests),
        checked(fmt::format("one by one, tests of triangles grow by a factor of at most {:g} with them",
                            kMostGrowth),
                many.triangle_tests <= kMostGrowth * few.triangle_tests),
        checked(
            fmt::format(
                "one by one, tests of boxes grow at most as much as the number of occluders, and tests of "
                "triangles at most {:g} times as much",
                kMostGrowth),
            dense.box_tests <= ratio * sparse.box_tests &&
                dense.triangle_tests <= kMostGrowth * ratio * sparse.triangle_tests),
        checked("together, lines take fewer tests of boxes, in all scenes",
                std::all_of(by_around.begin(), by_around.end(), tests_fewer_boxes_together) &&
                    std::all_of(by_occluders.begin(), by_occluders.end(), tests_fewer_boxes_together))};
}

Report report_of(const LineGrowthResult& result) {
    const LineGrowth& experiment = *result.experiment;
    Report report;
    report.setting =
        fmt::format("A floor, a light of 0.6 m one metre above it, small triangles in between, and triangles "
                    "around, which no line "
                    "meets. {} stratified, parallel lines for each of {} x {} points of the floor; means "
                    "over all lines. One by "
                    "one: binary hierarchy; together: hierarchy of width 8. Times are those of one thread.",
                    experiment.lines, experiment.width, experiment.width);
    report.tables = {table_of(fmt::format("triangles around, {} occluders", experiment.occluders.front()),
                              result.by_around, &GrowthSize::around),
                     table_of(fmt::format("occluders, {} triangles around", experiment.around.front()),
                              result.by_occluders, &GrowthSize::occluders)};
    report.expectations = result.expectations;
    report.plots = {
        plot_of("triangles around", "around", "triangles around", result.by_around, &GrowthSize::around),
        plot_of("occluders", "occluders", "occluders", result.by_occluders, &GrowthSize::occluders)};
    report.numbers = {
        experiment.name,
        {{"lines", experiment.lines}, {"width", experiment.width}},
        {numbers_of("by_around", result.by_around), numbers_of("by_occluders", result.by_occluders)}};
    return report;
}

} // namespace nusselt::lab
