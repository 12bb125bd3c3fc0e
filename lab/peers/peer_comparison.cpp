#include "lab/peers/peer_comparison.h"

#include "base/temporary_folder.h"
#include "image/io.h"
#include "lab/timing/child_process.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <unistd.h>

namespace nusselt::lab {

namespace {

/// As compare.py names renderers.
constexpr const char* kOurs = "nusselt";
constexpr const char* kLonger = "nusselt, equal time";
constexpr const char* kPeer = "cycles";

/// A program in a folder of PATH, or an empty path.
std::filesystem::path find_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path program = std::filesystem::path(folder) / name;
        if (::access(program.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(program)) return program;
    }
    return {};
}

/// The renderer, which the build puts beside the laboratory.
std::filesystem::path our_renderer() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "nusselt/nusselt";
}

Cell cell_from(const nlohmann::ordered_json& value) {
    if (value.is_null()) return nullptr;
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number_integer()) return value.get<std::int64_t>();
    if (value.is_number()) return value.get<double>();
    return value.get<std::string>();
}

ResultTable table_from(const nlohmann::ordered_json& json) {
    ResultTable table = {json.at("name"), {}};
    for (const auto& column : json.at("columns"))
        table.columns.push_back({column.at("name"), column.value("unit", "")});
    for (const auto& row : json.at("rows")) {
        if (row.size() != table.columns.size())
            throw std::runtime_error("table " + table.name + " has a row without a cell for each column");
        std::vector<Cell> cells;
        for (const auto& value : row) cells.push_back(cell_from(value));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

/// The rows of a table, whose cells have names.
class Rows {
public:
    Rows(const Results& results, const std::string& name) : table_(find(results, name)) {}

    /// The cell of the first row in which the first column that is asked for has a text.
    const Cell& cell(const std::string& column, const std::string& key_column, const std::string& key) const {
        for (const auto& row : table_.rows)
            if (row[index_of(key_column)] == Cell(key)) return row[index_of(column)];
        throw std::runtime_error("table " + table_.name + " has no row of " + key);
    }

private:
    static const ResultTable& find(const Results& results, const std::string& name) {
        for (const ResultTable& table : results.tables)
            if (table.name == name) return table;
        throw std::runtime_error("the comparison has no table " + name);
    }
    std::size_t index_of(const std::string& column) const {
        for (std::size_t i = 0; i < table_.columns.size(); ++i)
            if (table_.columns[i].name == column) return i;
        throw std::runtime_error("table " + table_.name + " has no column " + column);
    }

    const ResultTable& table_;
};

double number(const Cell& cell) {
    if (const auto* const integer = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*integer);
    if (const auto* const real = std::get_if<double>(&cell)) return *real;
    throw std::runtime_error("the comparison lacks a number");
}

/// Numbers of a result by the names of compare.py.
class Numbers {
public:
    explicit Numbers(const PeerComparisonResult& result) : result_(result) {}

    const Cell& scene(const std::string& table, const std::string& column) const {
        return Rows(result_.numbers, table).cell(column, "scene", result_.comparison.scene);
    }
    double of_scene(const std::string& table, const std::string& column) const {
        return number(scene(table, column));
    }
    double of_renderer(const std::string& renderer, const std::string& column) const {
        return number(Rows(result_.numbers, "renderings").cell(column, "renderer", renderer));
    }
    std::string setting(const std::string& name) const {
        for (const auto& [key, value] : result_.numbers.settings)
            if (key == name) return std::get<std::string>(value);
        throw std::runtime_error("the comparison has no setting " + name);
    }

private:
    const PeerComparisonResult& result_;
};

Table table_of(const Numbers& numbers) {
    Table table = {{"renderer", "samples", "time [s]", "RMSE / mean", "time / Cycles", "MSE / Cycles",
                    "relative MSE / Cycles", "efficiency / Cycles"}};
    for (const char* renderer : {kOurs, kLonger, kPeer}) {
        const auto ratio = [&](const char* column) {
            return fmt::format("{:.3g}",
                               numbers.of_renderer(renderer, column) / numbers.of_renderer(kPeer, column));
        };
        table.push_back({renderer, fmt::format("{:g}", numbers.of_renderer(renderer, "samples")),
                         fmt::format("{:.3g}", numbers.of_renderer(renderer, "cpu_seconds")),
                         fmt::format("{:.3g} %", 100 * numbers.of_renderer(renderer, "relative_rmse")),
                         ratio("cpu_seconds"), ratio("mse"), ratio("rel_mse"), ratio("efficiency")});
    }
    return table;
}

std::vector<ExpectationResult> expectations_of(const PeerComparison& comparison, const Numbers& numbers) {
    const double means = numbers.of_scene("references", "mean_ratio");
    std::vector<ExpectationResult> all = {
        checked(fmt::format("the means of the converged images differ by at most {:g} %",
                            100 * comparison.mean_tolerance),
                std::abs(means - 1) <= comparison.mean_tolerance)};
    if (numbers.scene("ratios", "target") != Cell(nullptr)) {
        const double target = numbers.of_scene("ratios", "target");
        all.push_back(
            checked(fmt::format("efficiency, 1 / (MSE x time), at equal samples: at least {:g} times "
                                "that of Cycles",
                                target),
                    numbers.of_scene("ratios", "efficiency_ratio") >= target));
    }
    return all;
}

std::string setting(const PeerComparison& comparison, const Numbers& numbers) {
    return fmt::format("One thread each; processor times, medians of {} repetitions. Pixels that show "
                       "emitters are left out of errors. Each renderer is compared with a converged image of "
                       "its own, of {} samples; the mean of that of Cycles is {:.4f} times ours. Blender {}.",
                       comparison.repetitions, comparison.reference_samples,
                       numbers.of_scene("references", "mean_ratio"), numbers.setting("cycles"));
}

std::vector<ReportImage> images_of(const PeerComparisonResult& result, const std::filesystem::path& folder) {
    const Numbers numbers(result);
    const auto picture = [&](const std::string& name) {
        return image::read_image(folder / (result.comparison.scene + "-" + name + "-picture.pfm"));
    };
    const auto samples = [&](const char* renderer) {
        return fmt::format("{:g}", numbers.of_renderer(renderer, "samples"));
    };
    const auto metrics = [&](const char* renderer) -> std::vector<std::pair<std::string, double>> {
        return {{"RMSE", std::sqrt(numbers.of_renderer(renderer, "mse"))},
                {"relative MSE", numbers.of_renderer(renderer, "rel_mse")}};
    };
    return {
        {"reference", ImageRole::reference, picture("nusselt-reference")},
        {"Nusselt, " + samples(kOurs) + " samples", ImageRole::variant, picture("nusselt-" + samples(kOurs)),
         metrics(kOurs)},
        {"Nusselt in the time of Cycles, " + samples(kLonger) + " samples", ImageRole::variant,
         picture("nusselt-" + samples(kLonger)), metrics(kLonger)},
        {"reference of Cycles", ImageRole::reference, picture("cycles-reference")},
        {"Cycles, " + samples(kPeer) + " samples", ImageRole::variant, picture("cycles-0"), metrics(kPeer)}};
}

/// Scripts, both renderers, and the files of the scene.
std::vector<std::filesystem::path> files_of(const PeerComparisonResult& result,
                                            const std::filesystem::path& root) {
    std::vector<std::filesystem::path> files = {our_renderer(), find_program("blender")};
    for (const auto& entry : std::filesystem::directory_iterator(root / "lab/peers"))
        if (entry.path().extension() == ".py" || entry.path().extension() == ".json")
            files.push_back(entry.path());
    for (const ResultTable& table : result.numbers.tables)
        if (table.name == "files")
            for (const auto& row : table.rows) files.push_back(root / std::get<std::string>(row.at(1)));
    return files;
}

} // namespace

const std::vector<PeerComparison>& all_peer_comparisons() {
    constexpr const char* kSource = "Today's renderers: Cycles of Blender";
    static const std::vector<PeerComparison> comparisons = {
        {"peers-panel", kSource, "A matte box under a panel that shines to both sides.", "panel", 0.01},
        {"peers-panel-below", kSource, "A matte box under a panel that shines downwards only.", "panel-below",
         0.01},
        {"peers-tube", kSource, "A matte box under a fluorescent tube, which is a mesh in Cycles.", "tube",
         0.01},
        {"peers-metal-planes", kSource, "Three metal planes of different roughness under a panel.",
         "metal-planes", 0.01},
        {"peers-room-matte", kSource, "A matte room under a tube and two panels.", "room-matte", 0.01},
        // Rough surfaces are brighter in Cycles, whose principled BSDF is not that of Frostbite: 4.5 % in the mean.
        {"peers-room", kSource, "The room with its materials, which are others in Cycles.", "room", 0.06}};
    return comparisons;
}

PeerComparison quick(PeerComparison comparison) {
    comparison.repetitions = 1;
    comparison.reference_samples = 64;
    comparison.shrink = 2;
    return comparison;
}

std::string obstacle(const PeerComparison& /*all of them need the same*/) {
    if (find_program("blender").empty())
        return "Blender is missing (Debian: apt-get install --no-install-recommends blender)";
    if (find_program("python3").empty()) return "python3 is missing";
    if (!std::filesystem::exists(our_renderer()))
        return our_renderer().string() + " is missing (make demo builds it)";
    return "";
}

PeerComparisonResult run_peer_comparison(const PeerComparison& comparison, const RunSettings& settings,
                                         const ProgressText& progress) {
    const std::filesystem::path root = std::filesystem::absolute(settings.scenes) / "..";
    const std::filesystem::path script = root / "lab/peers/compare.py";
    if (!std::filesystem::exists(script)) throw std::runtime_error("no file '" + script.string() + "'");
    progress(fmt::format("beside Cycles, {} samples for references", comparison.reference_samples));
    const base::TemporaryFolder work;
    const std::filesystem::path file = work / "numbers.json";
    run_child({"/usr/bin/env", "python3", script.string(), "--scenes", comparison.scene, "--repetitions",
               std::to_string(comparison.repetitions), "--reference-samples",
               std::to_string(comparison.reference_samples), "--shrink", std::to_string(comparison.shrink),
               "--json", file.string(), "--work", work.path().string(), "--nusselt",
               our_renderer().string()});
    std::ifstream stream(file);
    PeerComparisonResult result =
        peer_comparison_of(comparison, {std::istreambuf_iterator<char>(stream), {}});
    result.images = images_of(result, work.path());
    result.files = files_of(result, root);
    return result;
}

PeerComparisonResult peer_comparison_of(const PeerComparison& comparison, const std::string& json) {
    try {
        const auto document = nlohmann::ordered_json::parse(json);
        PeerComparisonResult result = {comparison, {comparison.name, {}, {}}, {}, {}};
        for (const auto& [name, value] : document.at("settings").items())
            result.numbers.settings.emplace_back(name, cell_from(value));
        for (const auto& table : document.at("tables")) result.numbers.tables.push_back(table_from(table));
        return result;
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(std::string("lab/peers/compare.py writes no such numbers: ") + error.what());
    }
}

Report report_of(const PeerComparisonResult& result) {
    const Numbers numbers(result);
    Report report = {setting(result.comparison, numbers),
                     {table_of(numbers)},
                     expectations_of(result.comparison, numbers)};
    report.images = result.images;
    report.numbers = result.numbers;
    report.inputs = result.files;
    return report;
}

} // namespace nusselt::lab
