#include "fit_ltc.h"
#include "apps/common/help.h"
#include "apps/common/interrupt.h"
#include "apps/common/print_message.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "base/file_checks.h"

#include "base/atomic_file.h"
#include "base/stopwatch.h"
#include "base/words.h"
#include "fit/table_error.h"
#include "fit/table_fit.h"
#include "image/io.h"
#include "render_cpu/renderer.h"
#include "tables/engine_table.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

using fit::Slice;
using fit::TableFit;
using tables::LtcTable;

constexpr int kColumnsPerThread = 16;
constexpr double kSecondsBetweenSaves = 20;
/// The reflectance whose lobe the table for engines stores. Dielectrics and metals lose about the same with it.
constexpr float kEngineF0 = 0.2f;
/// The samples of a table must be fewer.
constexpr std::int64_t kMostSamples = LtcTableView::kMostFloats / LtcTableView::kStride;

/// \returns nothing if the text is no size of a table
std::optional<fit::TableSize> parse_size(const std::string& text) {
    fit::TableSize size{};
    int end = 0;
    constexpr int kMost = LtcTableFile::kMostSamples;
    const auto is_fine = [](int n) { return n >= 2 && n <= kMost; };
    if (std::sscanf(text.c_str(), "%dx%dx%d%n", &size.roughness, &size.inclination, &size.f0, &end) != 3 ||
        static_cast<std::size_t>(end) != text.size() || !is_fine(size.roughness) ||
        !is_fine(size.inclination) || !is_fine(size.f0) ||
        std::int64_t{size.roughness} * size.inclination * size.f0 >= kMostSamples)
        return std::nullopt;
    return size;
}

std::string check_size(const std::string& text) {
    if (parse_size(text)) return "";
    return fmt::format("'{}' must be three numbers from 2 to {}, such as 64x64x51, with a product below {}",
                       text, LtcTableFile::kMostSamples, kMostSamples);
}

/// Fits all columns or until Ctrl-C, and leaves the checkpoint up to date. Returns the number of columns that it
/// fitted.
int fit_columns(const FitLtcOptions& options, TableFit& table, tbb::task_arena& arena) {
    const auto save = [&] {
        if (options.checkpoint) table.save(*options.checkpoint);
    };
    if (options.checkpoint) table.resume(*options.checkpoint);
    // Fails now rather than after minutes if the file cannot be written.
    save();

    base::Stopwatch since_saving;
    Progress progress;
    const int first = table.finished_columns();
    while (table.finished_columns() < table.columns() && !interrupted) {
        arena.execute([&] { table.run(kColumnsPerThread * arena.max_concurrency()); });
        progress.update(static_cast<double>(table.finished_columns() - first) / (table.columns() - first));
        if (since_saving.seconds() > kSecondsBetweenSaves) {
            save();
            since_saving = base::Stopwatch();
        }
    }
    progress.finish();
    save();
    return table.finished_columns() - first;
}

/// Calls f(roughness, inclination, f0) in the order of LtcTableView.
template <class Function>
void for_each_sample(const fit::TableSize& size, const Function& f) {
    for (int r = 0; r < size.roughness; ++r)
        for (int i = 0; i < size.inclination; ++i)
            for (int k = 0; k < size.f0; ++k) f(r, i, k);
}

LtcTable table_of(const TableFit& fitted) {
    const fit::TableSize& size = fitted.size();
    LtcTable table{size.roughness, size.inclination, size.f0, {}};
    for_each_sample(size, [&](int r, int i, int k) {
        const fit::FittedLobe& entry = fitted.entry(r, i, k);
        const auto c = fit::coefficients_of(entry.lobe, entry.albedo);
        for (const double x : {c.m00, c.m02, 1 / c.m11, -c.m20, c.m22, c.albedo})
            table.entries.push_back(static_cast<float>(x));
    });
    return table;
}

/// Some samples of the table, or centres of cells for an offset of one half, but f0 = 0.
std::vector<Slice> slices_of(const fit::TableSize& size, double offset) {
    std::vector<Slice> slices;
    const auto stride = [](int n) { return n > 16 ? 3 : 1; };
    const auto position = [offset](int i, int n) { return (i + offset) / (n - 1); };
    for_each_sample(size, [&](int r, int i, int k) {
        const Slice slice{position(r, size.roughness), kPi<double> / 2 * position(i, size.inclination),
                          position(k, size.f0)};
        const bool is_taken = r % stride(size.roughness) == 0 && i % stride(size.inclination) == 0 &&
                              k % stride(size.f0) == 0 && slice.f0 > 0;
        if (is_taken && slice.roughness <= 1 && slice.inclination <= kPi<double> / 2 && slice.f0 <= 1)
            slices.push_back(slice);
    });
    return slices;
}

struct ErrorRow {
    std::string what;
    fit::ErrorSummary errors;
};

std::vector<ErrorRow> measure(const fit::Brdf& brdf, const TableFit& fitted, const LtcTable& table,
                              const std::string& encoded, const std::string& for_engines) {
    std::vector<ErrorRow> rows;
    const auto add_fit = [&](const std::string& what, double smallest, double largest) {
        std::vector<double> errors;
        for_each_sample(fitted.size(), [&](int r, int i, int k) {
            const double roughness = static_cast<double>(r) / (fitted.size().roughness - 1);
            if (roughness >= smallest && roughness <= largest) errors.push_back(fitted.entry(r, i, k).error);
        });
        if (!errors.empty()) rows.push_back({what, fit::summary_of(std::move(errors))});
    };
    add_fit("all samples", 0, 1);
    for (int band = 0; band < 5; ++band)
        add_fit(fmt::format("roughness {:.1f} to {:.1f}", band * 0.2, (band + 1) * 0.2), band * 0.2,
                (band + 1) * 0.2);

    const LtcTable decoded = tables::decode(encoded, "the table");
    const LtcTable engine = tables::decode_for_engines(for_engines, table.roughnesses, table.inclinations,
                                                       "the table for engines");
    const auto add = [&](const std::string& what, const LtcTable& one, const std::vector<Slice>& slices) {
        rows.push_back({what, fit::summary_of(fit::fit_errors(brdf, one.view(), slices))});
    };
    const auto samples = slices_of(fitted.size(), 0);
    const auto centres = slices_of(fitted.size(), 0.5);
    add("some samples, float", table, samples);
    add("some samples, 16 bits", decoded, samples);
    add("some samples, for engines", engine, samples);
    add("centres of cells, float", table, centres);
    add("centres of cells, 16 bits", decoded, centres);
    add("centres of cells, for engines", engine, centres);
    return rows;
}

void print_errors(const std::vector<ErrorRow>& rows) {
    fmt::print("Integral of |BRDF cos / albedo - density| over the sphere, 0 to "
               "2:\n{:<32}{:>10}{:>10}{:>10}{:>10}{:>10}\n",
               "", "mean", "median", "90 %", "99 %", "largest");
    for (const auto& [what, e] : rows)
        fmt::print("{:<32}{:>10.4f}{:>10.4f}{:>10.4f}{:>10.4f}{:>10.4f}\n", what, e.mean, e.median,
                   e.percentile_90, e.percentile_99, e.largest);
}

lab::Results results_of(const FitLtcOptions& options, const std::vector<ErrorRow>& rows) {
    lab::ResultTable table = {
        "errors", {{"slices"}, {"mean"}, {"median"}, {"percentile_90"}, {"percentile_99"}, {"largest"}}};
    for (const auto& [what, e] : rows)
        table.rows.push_back({what, e.mean, e.median, e.percentile_90, e.percentile_99, e.largest});
    return {"fit-ltc", {{"brdf", options.brdf}, {"size", options.size}}, {std::move(table)}};
}

std::string sidecar(const FitLtcOptions& options, const TableFit& fitted, const std::string& encoded,
                    const std::vector<ErrorRow>& rows) {
    auto errors = nlohmann::ordered_json::object();
    for (const auto& [what, e] : rows)
        errors[what] = {{"mean", e.mean},
                        {"median", e.median},
                        {"percentile_90", e.percentile_90},
                        {"percentile_99", e.percentile_99},
                        {"largest", e.largest}};
    const nlohmann::ordered_json json = {
        {"command", fmt::format("nusselt-lab fit-ltc --brdf {} --size {} -o {}", options.brdf, options.size,
                                options.output)},
        {"commit", options.commit},
        {"brdf", options.brdf},
        {"axes",
         {{{"name", "perceptual roughness"}, {"from", 0}, {"to", 1}, {"samples", fitted.size().roughness}},
          {{"name", "inclination of wo [rad]"},
           {"from", 0},
           {"to", kPi<double> / 2},
           {"samples", fitted.size().inclination}},
          {{"name", "f0, innermost"}, {"from", 0}, {"to", 1}, {"samples", fitted.size().f0}}}},
        {"parametrisation",
         "five 16-bit numbers u per sample after a header of 40 bytes: peak and tilt, u / 65535 is the angle "
         "over "
         "pi / 2; width_x and width_y / width_x, u / 65535 is (log2(x) + 24) / 27; albedo, u / 65535. Rows "
         "of the "
         "matrix from shading to cosine space: (cos peak, 0, sin peak) / width_x, (0, 1, 0) / width_y, "
         "(-sin tilt, 0, cos tilt), for wo in the xz half-plane with x >= 0"},
        {"engine_table",
         "half floats per roughness and, innermost, inclination: 1024 m00 / m11, 1024 m20 / m11, 1024 m02 / "
         "m11, "
         "1024 m22 / m11 of that matrix (row, column), scale and bias of the albedo f0 scale + bias"},
        {"bytes", encoded.size()},
        {"fnv1a_64_of_bytes_from_40", fmt::format("{:016x}", tables::checksum_of(encoded))},
        {"fit_error", errors}};
    return json.dump(2) + "\n";
}

} // namespace

int run_fit_ltc(const FitLtcOptions& options) {
    const fit::Brdf& brdf = fit::find_brdf(options.brdf);
    // Fails now rather than after minutes of fitting.
    check_json_option(options.json);
    std::vector<std::filesystem::path> outputs;
    for (const char* extension : {".bin", "-engine.bin", ".json"}) {
        outputs.emplace_back(options.output + extension);
        base::check_writable(outputs.back());
    }
    if (options.json && options.json != "-") outputs.emplace_back(*options.json);
    if (options.checkpoint) outputs.push_back(*options.checkpoint);
    base::check_distinct(outputs, {});
    TableFit fitted(brdf, parse_size(options.size).value());
    tbb::task_arena arena(render_cpu::checked_thread_count(options.threads));
    const InterruptGuard guard;
    const base::Stopwatch stopwatch;
    const int columns = fit_columns(options, fitted, arena);
    const double seconds = stopwatch.seconds();
    if (interrupted) {
        print_message("stopped after {} of {} columns; {}\n", fitted.finished_columns(), fitted.columns(),
                      options.checkpoint ? "run the same command again to continue"
                                         : "they are lost; use --checkpoint to keep them");
        return interrupted_exit_code();
    }
    if (options.json != "-") fmt::print("{} columns in {:.0f} s\n", columns, seconds);

    const LtcTable table = table_of(fitted);
    const std::string encoded = tables::encode(table);
    const std::string for_engines = tables::encode_for_engines(table, kEngineF0);
    const auto rows = arena.execute([&] { return measure(brdf, fitted, table, encoded, for_engines); });
    write_results(options.json, results_of(options, rows), [&] { print_errors(rows); });
    const auto write = [](const std::filesystem::path& path, const std::string& bytes) {
        base::write_atomically(path, [&](std::ofstream& file) { file << bytes; });
    };
    write(options.output + ".bin", encoded);
    write(options.output + "-engine.bin", for_engines);
    write(options.output + ".json", sidecar(options, fitted, encoded, rows));
    return 0;
}

void setup_fit_ltc(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<FitLtcOptions>();
    CLI::App* command = app.add_subcommand(
        "fit-ltc", "Fit linearly transformed cosines to a BRDF times cosine and write them as a table.");
    std::vector<std::string> names, explained;
    for (const fit::Brdf& one : fit::brdfs()) {
        names.emplace_back(one.name);
        explained.push_back(fmt::format("{} ({})", one.name, one.description));
    }
    command
        ->add_option("--brdf", options->brdf, fmt::format("BRDF to fit: {}", base::listing(explained, "or")))
        ->transform(to_one_of(names));
    command
        ->add_option("--size", options->size,
                     fmt::format("Samples along perceptual roughness, inclination of wo and f0, 2 to {} each",
                                 LtcTableFile::kMostSamples))
        ->type_name("NxNxN")
        ->check(check_size);
    command
        ->add_option(
            "-o,--output", options->output,
            "Write OUTPUT.bin, its description OUTPUT.json, and OUTPUT-engine.bin, a small table with one "
            "lobe for all f0")
        ->type_name("OUTPUT")
        ->required()
        ->group(kOutputGroup);
    command
        ->add_option(
            "--checkpoint", options->checkpoint,
            "Store the state of the fit in this file, also upon Ctrl-C, and continue from it if it exists")
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kOutputGroup);
    command->add_option("--commit", options->commit, "Commit of the program, recorded in OUTPUT.json")
        ->type_name("COMMIT")
        ->group(kOutputGroup);
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_fit_ltc(*options); });
}

} // namespace nusselt::app
