#include "lab/tubes/light_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>

namespace nusselt::lab {

namespace {

constexpr std::string_view kNames[] = {"line", "analytic", "unclamped"};

std::string name_of(std::size_t approximation) { return std::string(kNames[approximation]); }

std::size_t count_of(const LightGridResult& result) { return result.cells.front().errors.size(); }

double error(const GridCell& cell, Approximation approximation) {
    return cell.errors.at(static_cast<std::size_t>(approximation)).rmse;
}

bool is_cylinder(const LightGridResult& result) { return result.grid.light == GridLight::cylinder; }

Table error_table(const LightGridResult& result) {
    const LightGrid& grid = result.grid;
    Table table = {{"RMSE / mean, line and analytic [%]"}};
    for (const float radius : grid.radii)
        table[0].push_back(is_cylinder(result) ? fmt::format("radius {} m", radius)
                                               : fmt::format("width {:.2f} m", 2 * radius));
    for (std::size_t d = 0; d < grid.distances.size(); ++d)
        for (std::size_t a = 0; a < grid.roughnesses.size(); ++a) {
            table.push_back(
                {fmt::format("distance {} m, roughness {}", grid.distances[d], grid.roughnesses[a])});
            for (std::size_t r = 0; r < grid.radii.size(); ++r) {
                const GridCell& c = cell(result, r, d, a);
                table.back().push_back(fmt::format("{:.1f}, {:.1f}", 100 * error(c, Approximation::line),
                                                   100 * error(c, Approximation::analytic)));
            }
        }
    return table;
}

/// Close to the light, on the most polished surface.
Table clamp_table(const LightGridResult& result) {
    Table table = {{"largest radiance over that of the light", "cylinder", "analytic", "without clamp",
                    "RMSE / mean of analytic", "without clamp"}};
    for (std::size_t r = 0; r < result.grid.radii.size(); ++r) {
        const GridCell& c = cell(result, r, 0, 0);
        const auto largest = [&](Approximation a) {
            return c.errors.at(static_cast<std::size_t>(a)).largest;
        };
        table.push_back({fmt::format("radius {} m", c.radius), fmt::format("{:.3f}", c.largest),
                         fmt::format("{:.3f}", largest(Approximation::analytic)),
                         fmt::format("{:.3f}", largest(Approximation::unclamped)),
                         fmt::format("{:.1f} %", 100 * error(c, Approximation::analytic)),
                         fmt::format("{:.1f} %", 100 * error(c, Approximation::unclamped))});
    }
    return table;
}

/// One of the three quantities by which the cells differ.
enum class Axis { radius, distance, roughness };

using GridIndex = std::array<std::size_t, 3>; ///< by Axis

GridIndex sizes_of(const LightGrid& grid) {
    return {grid.radii.size(), grid.distances.size(), grid.roughnesses.size()};
}

/// Calls a function for each cell.
void for_cells(const LightGridResult& result, const std::function<void(const GridIndex&)>& visit) {
    const GridIndex sizes = sizes_of(result.grid);
    for (std::size_t r = 0; r < sizes[0]; ++r)
        for (std::size_t d = 0; d < sizes[1]; ++d)
            for (std::size_t a = 0; a < sizes[2]; ++a) visit({r, d, a});
}

const GridCell& at(const LightGridResult& result, const GridIndex& i) {
    return cell(result, i[0], i[1], i[2]);
}

/// Of pairs of cells that differ by a step along an axis: how many there are, and in how many the error of the line is
/// larger behind the step.
struct Steps {
    int rising = 0;
    int count = 0;
};

Steps steps_along(const LightGridResult& result, Axis axis) {
    Steps steps;
    const auto k = static_cast<std::size_t>(axis);
    for_cells(result, [&](const GridIndex& i) {
        if (i[k] + 1 == sizes_of(result.grid)[k]) return;
        GridIndex next = i;
        ++next[k];
        ++steps.count;
        steps.rising +=
            error(at(result, next), Approximation::line) > error(at(result, i), Approximation::line);
    });
    return steps;
}

std::string times(int count, int all) { return fmt::format("in {} of {} steps", count, all); }

/// The largest and the smallest values of an axis are the first and the last of the grid.
void check_growth(const LightGridResult& result, std::vector<ExpectationResult>& expectations) {
    const Steps wider = steps_along(result, Axis::radius);
    const Steps farther = steps_along(result, Axis::distance);
    const Steps rougher = steps_along(result, Axis::roughness);
    expectations.push_back(
        checked("the error of lines grows with the width of the light " + times(wider.rising, wider.count),
                wider.rising == wider.count));
    expectations.push_back(checked("the error of lines falls with the distance " +
                                       times(farther.count - farther.rising, farther.count),
                                   farther.rising == 0));
    expectations.push_back(checked("the error of lines falls with the roughness " +
                                       times(rougher.count - rougher.rising, rougher.count),
                                   rougher.rising == 0));
    const GridIndex sizes = sizes_of(result.grid);
    const double best = error(cell(result, 0, sizes[1] - 1, sizes[2] - 1), Approximation::line);
    const double worst = error(cell(result, sizes[0] - 1, 0, 0), Approximation::line);
    expectations.push_back(checked(
        fmt::format("a thin, distant light on a rough surface is off by at most 1 %: {:.2g} %", 100 * best),
        best <= 0.01));
    expectations.push_back(
        checked(fmt::format("a thick, close light on a polished surface is off by at least 20 %: {:.3g} %",
                            100 * worst),
                worst >= 0.2));
}

void check_clamp(const LightGridResult& result, std::vector<ExpectationResult>& expectations) {
    double clamped = 0;
    double unclamped = 0;
    bool is_better = true;
    for (const GridCell& c : result.cells) {
        const auto& analytic = c.errors.at(static_cast<std::size_t>(Approximation::analytic));
        const auto& free = c.errors.at(static_cast<std::size_t>(Approximation::unclamped));
        clamped = std::max(clamped, analytic.largest);
        unclamped = std::max(unclamped, free.largest);
        // Where neither is clamped, they differ by rounding.
        is_better = is_better && analytic.rmse <= free.rmse * (1 + 1e-5);
    }
    expectations.push_back(
        checked(fmt::format("no pixel is brighter than the light: at most {:.3f} times as bright", clamped),
                clamped <= 1));
    expectations.push_back(
        checked(fmt::format("without the clamp, some are: up to {:.3f} times as bright", unclamped),
                unclamped > 1.1));
    expectations.push_back(checked("the clamp does not make the error of any image larger", is_better));
}

/// The images of all radii and roughnesses for one distance: roughness grows downwards, the radius to the right.
image::Image mosaic(const LightGridResult& result, std::size_t distance,
                    const std::function<const image::Image&(const GridCell&)>& image_of) {
    const LightGrid& grid = result.grid;
    const image::Image& first = result.cells.front().reference;
    const int columns = static_cast<int>(grid.radii.size());
    image::Image all =
        image::make_image(first.width * columns, first.height * static_cast<int>(grid.roughnesses.size()));
    for (std::size_t a = 0; a < grid.roughnesses.size(); ++a)
        for (std::size_t r = 0; r < grid.radii.size(); ++r) {
            const image::Image& part = image_of(cell(result, r, distance, a));
            const std::size_t row = 3 * static_cast<std::size_t>(part.width);
            for (std::size_t y = 0; y < static_cast<std::size_t>(part.height); ++y)
                std::copy_n(
                    &part.pixels[y * row], row,
                    &all.pixels[((a * static_cast<std::size_t>(part.height) + y) * grid.radii.size() + r) *
                                row]);
        }
    return all;
}

std::vector<ReportImage> images(const LightGridResult& result) {
    std::vector<ReportImage> all;
    const std::string light = is_cylinder(result) ? "cylinders" : "rectangles";
    for (std::size_t d = 0; d < result.grid.distances.size(); ++d) {
        const std::string where = fmt::format(", {} m", result.grid.distances[d]);
        all.push_back(
            {light + where, ImageRole::reference,
             mosaic(result, d, [](const GridCell& c) -> const image::Image& { return c.reference; })});
        for (std::size_t i = 0; i < count_of(result); ++i)
            all.push_back(
                {name_of(i) + where, ImageRole::variant,
                 mosaic(result, d, [i](const GridCell& c) -> const image::Image& { return c.images[i]; })});
    }
    return all;
}

/// For the distance in the middle.
Plot plot(const LightGridResult& result) {
    const LightGrid& grid = result.grid;
    const std::size_t middle = grid.distances.size() / 2;
    Plot all = {fmt::format("Errors at a distance of {} m", grid.distances[middle]),
                grid.name + "-errors",
                is_cylinder(result) ? "radius [m]" : "width [m]",
                "RMSE / mean",
                {}};
    for (const Approximation approximation : {Approximation::line, Approximation::analytic})
        for (std::size_t a = 0; a < grid.roughnesses.size(); ++a) {
            PlotCurve curve = {fmt::format("{}, roughness {}",
                                           name_of(static_cast<std::size_t>(approximation)),
                                           grid.roughnesses[a]),
                               {},
                               approximation == Approximation::line ? Stroke::solid : Stroke::dashed};
            for (std::size_t r = 0; r < grid.radii.size(); ++r) {
                const GridCell& c = cell(result, r, middle, a);
                const double e = error(c, approximation);
                curve.points.push_back({is_cylinder(result) ? c.radius : 2.0 * c.radius, e, e, e});
            }
            all.curves.push_back(std::move(curve));
        }
    return all;
}

Results numbers_of(const LightGridResult& result) {
    ResultTable errors = {"errors",
                          {{"radius", "m"},
                           {"distance", "m"},
                           {"roughness"},
                           {"approximation"},
                           {"relative_rmse"},
                           {"largest"},
                           {"largest_of_reference"}}};
    for (const GridCell& c : result.cells)
        for (std::size_t i = 0; i < c.errors.size(); ++i)
            errors.rows.push_back({static_cast<double>(c.radius), static_cast<double>(c.distance),
                                   static_cast<double>(c.roughness), name_of(i), c.errors[i].rmse,
                                   c.errors[i].largest, c.largest});
    return {result.grid.name,
            {{"width", std::int64_t(result.grid.width)}, {"samples", std::int64_t(result.grid.samples)}},
            {std::move(errors)}};
}

} // namespace

Report report_of(const LightGridResult& result) {
    Report report;
    report.setting = fmt::format("References take {} samples per pixel of the {}. 'line' is sampled as well, "
                                 "so that its error is that of the line alone; 'analytic' also has that of "
                                 "the fitted lobes. Images are mosaics: the width of the light grows to the "
                                 "right, the roughness downwards.",
                                 result.grid.samples,
                                 is_cylinder(result) ? "lateral surface of the cylinder" : "rectangle");
    report.tables = {error_table(result)};
    check_growth(result, report.expectations);
    if (is_cylinder(result)) {
        report.tables.push_back(clamp_table(result));
        check_clamp(result, report.expectations);
        double largest = 0;
        for (const GridCell& c : result.cells)
            largest =
                std::max(largest, c.errors.at(static_cast<std::size_t>(Approximation::analytic)).largest);
        report.measured.push_back(
            {"ltc-lines-sec-1.2.5-clamp", "largest value of a normalized lobe", largest});
    }
    report.images = images(result);
    report.plots = {plot(result)};
    report.numbers = numbers_of(result);
    report.inputs = result.files;
    return report;
}

} // namespace nusselt::lab
