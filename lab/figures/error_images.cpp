#include "lab/figures/error_images.h"

#include "image/difference.h"
#include "proof/quantile.h"
#include "render/film.h"
#include "scene/import/importers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nusselt::lab {

namespace {

/// Residual areas are below this almost everywhere [sr] (Peters 2021, polygonal lights, Sec. 3.6).
constexpr double kSmallArea = 1e-7;
constexpr double kLargeError = 1e-3;

/// Errors of pixels with light, sorted.
std::vector<double> lit(const image::Plane& plane) {
    std::vector<double> values;
    for (const double v : plane.values)
        if (v != PixelErrors::kDark) values.push_back(v);
    std::sort(values.begin(), values.end());
    return values;
}

/// Of pixels with light.
double share_above(const image::Plane& plane, double limit) {
    const std::vector<double> values = lit(plane);
    const auto above = std::count_if(values.begin(), values.end(), [&](double v) { return v > limit; });
    return values.empty() ? 0 : static_cast<double>(above) / static_cast<double>(values.size());
}

/// Decades from `low` to `high` as shares of the false colours.
image::Image logarithmic(image::Plane plane, double low, double high) {
    for (double& v : plane.values)
        v = v > 0 ? std::clamp(std::log(v / low) / std::log(high / low), 0.0, 1.0) : 0;
    return image::error_map_image(plane);
}

struct Scale {
    const char* name;
    const image::Plane PixelErrors::*plane;
    double low, high;
};
constexpr Scale kScales[] = {{"backward error", &PixelErrors::backward, 1e-8, 1},
                             {"times the measure of the light", &PixelErrors::area, 1e-10, 1e-4}};

Table table_of(const ErrorImagesResult& result) {
    Table table = {{"errors of pixels with light", "median", "99 %", "99.9 %", "largest",
                    fmt::format("above {:g}", kLargeError), fmt::format("area above {:g}", kSmallArea)}};
    for (std::size_t i = 0; i < result.errors.size(); ++i) {
        const PixelErrors& errors = result.errors[i];
        const std::vector<double> sorted = lit(errors.backward);
        table.push_back({result.experiment.techniques[i],
                         fmt::format("{:.1e}", proof::quantile_of_sorted(sorted, 0.5)),
                         fmt::format("{:.1e}", proof::quantile_of_sorted(sorted, 0.99)),
                         fmt::format("{:.1e}", proof::quantile_of_sorted(sorted, 0.999)),
                         fmt::format("{:.1e}", proof::quantile_of_sorted(sorted, 1)),
                         fmt::format("{:.3f} %", 100 * share_above(errors.backward, kLargeError)),
                         fmt::format("{:.3f} %", 100 * share_above(errors.area, kSmallArea))});
    }
    return table;
}

std::vector<ExpectationResult> check(const ErrorImagesResult& result) {
    const PixelErrors& ours = result.errors.back();
    const double large = share_above(ours.backward, kLargeError);
    std::vector<ExpectationResult> all = {checked(
        fmt::format("our backward errors are above {:g} in {:.3f} % of the pixels with light, at most 0.01 %",
                    kLargeError, 100 * large),
        large <= 1e-4)};
    if (result.experiment.quantity.empty()) return all;
    const double area = share_above(ours.area, kSmallArea);
    all.push_back(checked(
        fmt::format("times the measure, they are below {:g} almost everywhere: above in {:.2f} % of the "
                    "pixels with light",
                    kSmallArea, 100 * area),
        area < 0.01));
    return all;
}

Results numbers_of(const ErrorImagesResult& result) {
    ResultTable table = {"errors",
                         {{"technique"}, {"median"}, {"p99"}, {"largest"}, {"above"}, {"area_above"}}};
    for (std::size_t i = 0; i < result.errors.size(); ++i) {
        const std::vector<double> sorted = lit(result.errors[i].backward);
        table.rows.push_back({result.experiment.techniques[i], proof::quantile_of_sorted(sorted, 0.5),
                              proof::quantile_of_sorted(sorted, 0.99), proof::quantile_of_sorted(sorted, 1),
                              share_above(result.errors[i].backward, kLargeError),
                              share_above(result.errors[i].area, kSmallArea)});
    }
    return {result.experiment.name, {{"above", kLargeError}, {"area_above", kSmallArea}}, {std::move(table)}};
}

} // namespace

const std::vector<ErrorImages>& all_error_images() {
    static const std::vector<ErrorImages> experiments = {
        {"polygon-errors",
         "Peters 2021, polygonal lights, Fig. 6",
         "Backward errors of samples in single precision, in the box with a panel.",
         "cornell-panel.pbrt",
         {"PolygonProjectedSolidAngleArvo", "PolygonProjectedSolidAnglePeters", "PolygonProjectedSolidAngle"},
         "polygons-fig-6",
         "bound of the error times the projected solid angle, nearly everywhere"},
        {"line-errors",
         "Peters 2021, linear lights, Fig. 4",
         "Backward errors of samples in single precision, in the box with half a tube.",
         "evidence/cornell-half-tube.pbrt",
         {"LineProjectedSolidAngleLi", "LineProjectedSolidAnglePeters", "LineProjectedSolidAngle"},
         "lines-fig-4",
         ""}};
    return experiments;
}

ErrorImages quick(ErrorImages experiment) {
    experiment.width = 192;
    return experiment;
}

ErrorImagesResult run_error_images(const ErrorImages& experiment, const RunSettings& settings,
                                   const ProgressText& progress) {
    scene::Scene scene = scene::load_scene(settings.scenes / experiment.scene);
    if (experiment.width > 0) render::resize_film_to_width(scene, experiment.width);
    const render_cpu::Renderer renderer(scene, thread_count(settings));
    const TechniqueImages images(scene, renderer);
    ErrorImagesResult result = {experiment, images.render(experiment.techniques.back(), 0), {}, scene.files};
    for (const std::string& technique : experiment.techniques) {
        progress(technique);
        result.errors.push_back(images.backward_errors(technique, 0));
    }
    return result;
}

Report report_of(const ErrorImagesResult& result) {
    Report report;
    report.setting =
        "The exact result is that in long double for the same light. Scales of the pictures are logarithmic.";
    report.tables = {table_of(result)};
    report.expectations = check(result);
    report.images.push_back({"one sample per pixel", ImageRole::reference, result.image});
    for (std::size_t i = 0; i < result.errors.size(); ++i)
        for (const Scale& scale : kScales)
            report.images.push_back(
                {fmt::format("{}, {}, {:g} (black) to {:g} (light yellow)", result.experiment.techniques[i],
                             scale.name, scale.low, scale.high),
                 ImageRole::picture, logarithmic(result.errors[i].*scale.plane, scale.low, scale.high)});
    if (!result.experiment.quantity.empty())
        report.measured.push_back({result.experiment.item, result.experiment.quantity,
                                   proof::quantile_of_sorted(lit(result.errors.back().area), 0.99)});
    report.numbers = numbers_of(result);
    report.inputs = result.files;
    return report;
}

} // namespace nusselt::lab
