#include "bench_scale.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/timing/scale.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace nusselt::app {

namespace {

/// `nusselt`, which lies beside this program where both are installed, or in the next folder where they were built.
/// \throws std::runtime_error if it is in neither place
std::filesystem::path renderer_program() {
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    for (const std::filesystem::path& program :
         {folder / "nusselt", folder.parent_path() / "nusselt" / "nusselt"})
        if (std::filesystem::is_regular_file(program)) return program;
    throw std::runtime_error("cannot find the program `nusselt`, which this command measures, beside '" +
                             folder.string() + "/nusselt-lab'; build or install it");
}

using lab::ScaleRow;
using lab::ScaleScene;

/// Files and arrays of the largest scene have tens of gigabytes.
constexpr std::uint64_t kMaxTriangles = 1'000'000'000;

double ratio(std::uint64_t a, std::uint64_t b) { return static_cast<double>(a) / static_cast<double>(b); }

void print_row(const ScaleRow& row) {
    const auto nanoseconds = [&](double seconds) {
        return 1e9 * seconds / static_cast<double>(row.triangles);
    };
    constexpr double kMegabyte = 1e6;
    fmt::print("{:>12}{:>10.1f}{:>10.3f}{:>10.3f}{:>10.3f}{:>9.0f}{:>9.0f}{:>9.0f}{:>9.2f}{:>9.2f}\n",
               row.triangles, static_cast<double>(row.array_bytes) / kMegabyte, row.load_seconds,
               row.hierarchy_seconds, row.render_seconds, nanoseconds(row.load_seconds),
               nanoseconds(row.hierarchy_seconds), nanoseconds(row.render_seconds),
               ratio(row.load_bytes, row.array_bytes), ratio(row.render_bytes, row.array_bytes));
}

void print_rows(const char* title, const std::vector<ScaleRow>& rows) {
    if (rows.empty()) return;
    fmt::print("{}\n{:>12}{:>10}{:>10}{:>10}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}\n", title, "triangles",
               "arrays MB", "load s", "BVH s", "render s", "ns/tri.", "ns/tri.", "ns/tri.", "x load",
               "x render");
    for (const ScaleRow& row : rows) print_row(row);
    const auto power = [](const std::optional<double>& exponent) {
        return exponent ? fmt::format("n^{:.2f}", *exponent) : "(too few triangles)";
    };
    fmt::print("from the second-largest scene to the largest: time grows like {}, memory like {}\n",
               power(time_exponent(rows)), power(memory_exponent(rows)));
}

} // namespace

void setup_bench_scale(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchScaleOptions>();
    CLI::App* command = bench.add_subcommand(
        "scale", "Time and memory of generated scenes that grow to the given sizes in four steps. The last "
                 "columns are the peak "
                 "memory until the scene is loaded, and until the image is rendered, over the size of the "
                 "scene's arrays; both "
                 "without the memory that the program needs for a scene of a few triangles.");
    command->add_option("--triangles", options->triangles, "Triangles of the largest terrain, 0 for none")
        ->transform(to_whole_number(0, kMaxTriangles));
    command
        ->add_option("--emissive", options->emissive,
                     "Triangles of the largest emissive mesh, each of them a light, 0 for none")
        ->transform(to_whole_number(0, kMaxTriangles));
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] {
        if (options->triangles == 0 && options->emissive == 0)
            throw CLI::ValidationError("--triangles", "0 leaves nothing to measure, as --emissive is 0 too");
        exit_code = run_bench_scale(*options);
    });
}

int run_bench_scale(const BenchScaleOptions& options) {
    check_json_option(options.json);
    const auto rows = [](ScaleScene scene, std::uint64_t largest) {
        return largest > 0 ? lab::measure_scale(scene, largest, renderer_program()) : std::vector<ScaleRow>{};
    };
    const std::vector<ScaleRow> terrains = rows(ScaleScene::terrain, options.triangles);
    const std::vector<ScaleRow> lights = rows(ScaleScene::light, options.emissive);
    std::vector<ScaleRow> all = terrains;
    all.insert(all.end(), lights.begin(), lights.end());
    const lab::Results results = {
        "scale",
        {{"largest_terrain", options.triangles}, {"largest_light", options.emissive}},
        {lab::scale_table(all)}};
    write_results(options.json, results, [&] {
        print_rows("Terrains", terrains);
        print_rows("Lights", lights);
    });
    return 0;
}

} // namespace nusselt::app
