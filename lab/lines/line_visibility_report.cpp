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

/// The render time if lines were traced one by one in all pixels [s].
double render_seconds_one_by_one(const LineVisibilityScene& scene) {
    const render::RenderStatistics& s = scene.statistics;
    const auto lines = static_cast<double>(s.lines.lines);
    return s.render_seconds +
           (lines * scene.one_by_one.seconds_per_line() - s.lines.visibility_seconds) / s.threads;
}

/// Of one thread.
double visibility_seconds_per_line(const render::RenderStatistics& s) {
    return s.lines.visibility_seconds / static_cast<double>(std::max<std::uint64_t>(s.lines.lines, 1));
}

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

/// Tests for one line, one thread.
Table one_by_one_table(const LineVisibilityResult& result) {
    Table table = {{"per line", "boxes, one by one", "boxes, together", "triangles, one by one",
                    "triangles, together", "one by one [us]", "together [us]", "visible parts, one by one",
                    "visible parts, together"}};
    for (const LineVisibilityScene& scene : result.scenes) {
        if (scene.is_skipped) continue;
        const LineByLineWork& w = scene.one_by_one;
        const render::RenderStatistics& s = scene.statistics;
        table.push_back({scene.scene, fmt::format("{:.4g}", scene.work_one_by_one.box_tests),
                         fmt::format("{:.3g}", scene.work.box_tests),
                         fmt::format("{:.4g}", scene.work_one_by_one.triangle_tests),
                         fmt::format("{:.3g}", scene.work.triangle_tests),
                         fmt::format("{:.3g}", 1e6 * w.seconds_per_line()),
                         fmt::format("{:.3g}", 1e6 * visibility_seconds_per_line(s)),
                         fmt::format("{:.3f}", scene.work_one_by_one.parts),
                         fmt::format("{:.3f}", scene.parts_together)});
    }
    return table;
}

/// The numbers of Table 1, as if lines were traced one by one in all pixels of our images. Rates are those of the paper: tests
/// over the time of the whole rendering.
std::vector<Measured> measured(const LineVisibilityResult& result) {
    const std::string& item = result.experiment->table_item;
    std::vector<Measured> all;
    if (item.empty()) return all;
    for (const LineVisibilityScene& scene : result.scenes) {
        if (scene.is_skipped) continue;
        const std::string name = published_name(scene.scene) + ": ";
        const auto lines = static_cast<double>(scene.statistics.lines.lines);
        const double seconds = render_seconds_one_by_one(scene);
        const double boxes = 1e-6 * lines * scene.work_one_by_one.box_tests;
        const double triangles = 1e-6 * lines * scene.work_one_by_one.triangle_tests;
        all.push_back({item, name + "render time", seconds});
        all.push_back({item, name + "tests of boxes", boxes});
        all.push_back({item, name + "tests of triangles", triangles});
        all.push_back({item, name + "tests of boxes per second", boxes / seconds});
        all.push_back({item, name + "tests of triangles per second", triangles / seconds});
    }
    if (!all.empty())
        all.push_back({item, "lines per shading point", static_cast<double>(result.experiment->lines)});
    return all;
}

std::string setting(const LineVisibilityResult& result) {
    return fmt::format("Images are {} pixels wide; {} stratified, parallel lines per shading point. "
                       "Together: all lines of a point "
                       "traverse a hierarchy of width 8, most of whose boxes are tested against all lines at "
                       "once. One by one: each "
                       "line traverses a binary hierarchy, in every {}th pixel of every {}th row; times "
                       "per line are those of one thread. Lines together are packs, lines one by one "
                       "scalar code for the same instruction set.",
                       result.width, result.experiment->lines, result.experiment->step,
                       result.experiment->step);
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
    ResultTable one_by_one = {"one_by_one",
                              {{"scene"},
                               {"lines"},
                               {"box_tests_per_line"},
                               {"box_tests_per_line_together"},
                               {"triangle_tests_per_line"},
                               {"triangle_tests_per_line_together"},
                               {"seconds_per_line", "s"},
                               {"seconds_per_line_together", "s"},
                               {"parts_per_line"},
                               {"parts_per_line_together"}}};
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
        const LineByLineWork& w = scene.one_by_one;
        one_by_one.rows.push_back(
            {scene.scene, w.counts.lines, scene.work_one_by_one.box_tests, scene.work.box_tests,
             scene.work_one_by_one.triangle_tests, scene.work.triangle_tests, w.seconds_per_line(),
             visibility_seconds_per_line(s), scene.work_one_by_one.parts, scene.parts_together});
    }
    return {result.experiment->name,
            {{"width", result.width}, {"lines", result.experiment->lines}, {"step", result.experiment->step}},
            {std::move(scenes), std::move(one_by_one), std::move(skipped)}};
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
    Report report = {setting(result),
                     {work_table(result), line_table(result), one_by_one_table(result)},
                     result.expectations};
    report.measured = measured(result);
    report.images = images(result);
    report.numbers = numbers_of(result);
    for (const LineVisibilityScene& scene : result.scenes)
        report.inputs.insert(report.inputs.end(), scene.files.begin(), scene.files.end());
    return report;
}

} // namespace nusselt::lab
