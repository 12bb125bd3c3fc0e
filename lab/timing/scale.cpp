#include "lab/timing/scale.h"

#include "base/temporary_folder.h"
#include "lab/timing/child_process.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace nusselt::lab {

namespace {

/// Writes, loads and renders a scene. The memory includes what the program needs for any scene.
ScaleRow measure_row(ScaleScene scene, std::uint64_t triangles, const std::filesystem::path& program) {
    const base::TemporaryFolder folder;
    ScaleRow row{};
    row.scene = scene;
    row.triangles = write_scale_scene(scene, triangles, folder.path());
    const std::string file = (folder.path() / "scene.pbrt").string();
    row.load_bytes = run_child({program.string(), "info", file}).peak_bytes;
    const ChildResult rendering = run_child({program.string(), "render", file, "--quiet", "--json", "-",
                                             "--output", (folder.path() / "image.exr").string()});
    row.render_bytes = rendering.peak_bytes;
    const nlohmann::json report = nlohmann::json::parse(rendering.output);
    row.array_bytes = report.at("scene_bytes");
    row.load_seconds = report.at("seconds").at("load");
    row.hierarchy_seconds = report.at("seconds").at("bvh");
    row.render_seconds = report.at("seconds").at("render");
    return row;
}

/// The exponent of a quantity's growth from the last row but one to the last.
template <class Quantity>
std::optional<double> exponent(const std::vector<ScaleRow>& rows, const Quantity& quantity) {
    if (rows.size() < 2) return {};
    const ScaleRow& before = rows[rows.size() - 2];
    const ScaleRow& after = rows.back();
    if (before.triangles == after.triangles || !(quantity(before) > 0 && quantity(after) > 0)) return {};
    return std::log(quantity(after) / quantity(before)) /
           std::log(static_cast<double>(after.triangles) / static_cast<double>(before.triangles));
}

std::string name_of(ScaleScene scene) { return scene == ScaleScene::terrain ? "terrain" : "light"; }

} // namespace

std::vector<ScaleRow> measure_scale(ScaleScene scene, std::uint64_t largest,
                                    const std::filesystem::path& program) {
    constexpr std::uint64_t kTiny = 8;
    const ScaleRow tiny = measure_row(scene, kTiny, program);
    std::vector<ScaleRow> rows;
    for (const std::uint64_t divisor : {1000u, 100u, 10u, 1u}) {
        ScaleRow row = measure_row(scene, std::max(largest / divisor, kTiny), program);
        row.load_bytes -= std::min(row.load_bytes, tiny.load_bytes);
        row.render_bytes -= std::min(row.render_bytes, tiny.render_bytes);
        rows.push_back(row);
    }
    return rows;
}

std::optional<double> time_exponent(const std::vector<ScaleRow>& rows) {
    return exponent(rows, [](const ScaleRow& row) {
        // The time for rendering terrain mostly depends on the number of pixels.
        const bool counts = row.scene == ScaleScene::light;
        return row.load_seconds + row.hierarchy_seconds + (counts ? row.render_seconds : 0);
    });
}

std::optional<double> memory_exponent(const std::vector<ScaleRow>& rows) {
    return exponent(rows, [](const ScaleRow& row) { return static_cast<double>(row.render_bytes); });
}

ResultTable scale_table(const std::vector<ScaleRow>& rows) {
    ResultTable table = {"scale",
                         {{"scene"},
                          {"triangles"},
                          {"array_bytes", "B"},
                          {"load_seconds", "s"},
                          {"hierarchy_seconds", "s"},
                          {"render_seconds", "s"},
                          {"load_bytes", "B"},
                          {"render_bytes", "B"},
                          {"load_over_arrays"},
                          {"render_over_arrays"}}};
    const auto ratio = [](std::uint64_t a, std::uint64_t b) {
        return static_cast<double>(a) / static_cast<double>(b);
    };
    for (const ScaleRow& row : rows)
        table.rows.push_back({name_of(row.scene), row.triangles, row.array_bytes, row.load_seconds,
                              row.hierarchy_seconds, row.render_seconds, row.load_bytes, row.render_bytes,
                              ratio(row.load_bytes, row.array_bytes),
                              ratio(row.render_bytes, row.array_bytes)});
    return table;
}

} // namespace nusselt::lab
