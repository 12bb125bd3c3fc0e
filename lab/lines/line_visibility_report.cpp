#include "lab/lines/line_visibility.h"

#include "image/difference.h"

#include <fmt/format.h>

#include <algorithm>

namespace nusselt::lab {

namespace {

double largest(const image::Plane& plane) {
    return *std::max_element(plane.values.begin(), plane.values.end());
}

/// Of all scenes, at least 1.
double largest_parts(const LineVisibilityResult& result) {
    double parts = 1;
    for (const LineVisibilityScene& scene : result.scenes)
        if (!scene.is_skipped) parts = std::max(parts, largest(scene.parts));
    return parts;
}

/// Counts and rates in millions, as in the paper.
std::string millions(double number) { return fmt::format("{:.3g} M", 1e-6 * number); }

Table work_table(const LineVisibilityResult& result) {
    Table table = {{"scene and light", "render time [s]", "of it visibility", "lines", "tests of boxes",
                    "of triangles", "boxes / s", "triangles / s", "lines / s"}};
    for (const LineVisibilityScene& scene : result.scenes) {
        table.push_back({scene.scene});
        if (scene.is_skipped) {
            table.back().push_back("skipped");
            continue;
        }
        const render::RenderStatistics& s = scene.statistics;
        const auto boxes = static_cast<double>(s.lines.box_tests);
        const auto triangles = static_cast<double>(s.lines.triangle_tests);
        const auto lines = static_cast<double>(s.lines.lines);
        for (const std::string& cell :
             {fmt::format("{:.3f}", s.render_seconds),
              fmt::format("{:.0f} %", 100 * s.lines.visibility_seconds / (s.render_seconds * s.threads)),
              millions(lines), millions(boxes), millions(triangles), millions(boxes / s.render_seconds),
              millions(triangles / s.render_seconds), millions(lines / s.render_seconds)})
            table.back().push_back(cell);
    }
    return table;
}

Table line_table(const LineVisibilityResult& result) {
    Table table = {{"per line", "tests of boxes", "of triangles", "visible parts",
                    "most in a pixel (mean of its lines)"}};
    for (const LineVisibilityScene& scene : result.scenes) {
        if (scene.is_skipped) continue;
        table.push_back({scene.scene, fmt::format("{:.3g}", scene.work.box_tests),
                         fmt::format("{:.3g}", scene.work.triangle_tests),
                         fmt::format("{:.2f}", scene.work.parts),
                         fmt::format("{:.2f}", largest(scene.parts))});
    }
    return table;
}

std::string setting(const LineVisibilityResult& result) {
    return fmt::format("Images are {} pixels wide; {} stratified, parallel lines per shading point.",
                       result.width, result.experiment->lines);
}

Results numbers_of(const LineVisibilityResult& result) {
    ResultTable scenes = {"scenes",
                          {{"scene"},
                           {"render_seconds", "s"},
                           {"visibility_share"},
                           {"lines"},
                           {"box_tests"},
                           {"triangle_tests"},
                           {"boxes_per_second", "1/s"},
                           {"triangles_per_second", "1/s"},
                           {"lines_per_second", "1/s"},
                           {"parts_per_line"},
                           {"most_parts"}}};
    ResultTable skipped = {"skipped", {{"scene"}}};
    for (const LineVisibilityScene& scene : result.scenes) {
        if (scene.is_skipped) {
            skipped.rows.push_back({scene.scene});
            continue;
        }
        const render::RenderStatistics& s = scene.statistics;
        const auto rate = [&](std::uint64_t count) { return static_cast<double>(count) / s.render_seconds; };
        scenes.rows.push_back(
            {scene.scene, s.render_seconds, s.lines.visibility_seconds / (s.render_seconds * s.threads),
             s.lines.lines, s.lines.box_tests, s.lines.triangle_tests, rate(s.lines.box_tests),
             rate(s.lines.triangle_tests), rate(s.lines.lines), scene.work.parts, largest(scene.parts)});
    }
    return {result.experiment->name,
            {{"width", result.width}, {"lines", result.experiment->lines}},
            {std::move(scenes), std::move(skipped)}};
}

/// Images, and the visible parts per line in false colours on one scale.
std::vector<ReportImage> images(const LineVisibilityResult& result) {
    const double scale = largest_parts(result);
    std::vector<ReportImage> all;
    for (const LineVisibilityScene& scene : result.scenes) {
        if (scene.is_skipped) continue;
        image::Plane shares = scene.parts;
        for (double& value : shares.values) value /= scale;
        all.push_back({scene.scene, ImageRole::reference, scene.image});
        all.push_back({fmt::format("{}, visible parts per line from 0 (black) to {:.1f} (light yellow)",
                                   scene.scene, scale),
                       ImageRole::picture, image::error_map_image(shares)});
    }
    return all;
}

} // namespace

Report report_of(const LineVisibilityResult& result) {
    Report report = {setting(result), {work_table(result), line_table(result)}, result.expectations};
    report.images = images(result);
    report.numbers = numbers_of(result);
    for (const LineVisibilityScene& scene : result.scenes)
        report.inputs.insert(report.inputs.end(), scene.files.begin(), scene.files.end());
    return report;
}

} // namespace nusselt::lab
