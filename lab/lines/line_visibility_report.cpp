#include "lab/lines/line_visibility.h"

#include "base/atomic_file.h"
#include "image/difference.h"
#include "image/io.h"
#include "lab/figures/report_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace nusselt::lab {

namespace {

double largest(const image::Plane& plane) {
    return *std::max_element(plane.values.begin(), plane.values.end());
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

std::string figure(const std::string& caption, const std::string& file) {
    return fmt::format("<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>\n", file,
                       caption);
}

} // namespace

std::string to_text(const LineVisibilityResult& result) {
    return fmt::format("{}: {}\n{}\n{}\n\n{}\n{}\n{}", result.experiment->name, result.experiment->source,
                       result.experiment->description, setting(result), to_text(work_table(result)),
                       to_text(line_table(result)), to_text(result.expectations));
}

Results results_of(const LineVisibilityResult& result) {
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
            {std::move(scenes), std::move(skipped), expectation_table(result.expectations)}};
}

void write_report(const LineVisibilityResult& result, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const LineVisibility& experiment = *result.experiment;
    std::string html =
        page_head(experiment.name) +
        fmt::format("<p>{}. {} {}</p>\n", experiment.source, experiment.description, setting(result)) +
        to_html(work_table(result)) + to_html(line_table(result)) + to_html(result.expectations);
    double scale = 1;
    for (const LineVisibilityScene& scene : result.scenes)
        if (!scene.is_skipped) scale = std::max(scale, largest(scene.parts));
    html += fmt::format("<p>Visible parts per line from 0 (black) to {:.1f} (light yellow).</p>\n", scale);
    for (const LineVisibilityScene& scene : result.scenes) {
        if (scene.is_skipped) continue;
        image::Plane shares = scene.parts;
        for (double& value : shares.values) value /= scale;
        std::string name = scene.scene;
        name.erase(std::remove(name.begin(), name.end(), ','), name.end());
        std::replace(name.begin(), name.end(), ' ', '-');
        image::write_image(folder / (name + ".png"), scene.image);
        image::write_image(folder / (name + "-parts.png"), image::error_map_image(shares));
        html += figure(scene.scene, name + ".png") + figure(scene.scene + ", parts", name + "-parts.png");
    }
    base::write_atomically(folder / "index.html", [&](std::ofstream& file) { file << html; });
    base::write_atomically(folder / "numbers.json",
                           [&](std::ofstream& file) { file << to_json(results_of(result)); });
}

} // namespace nusselt::lab
