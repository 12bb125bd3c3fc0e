#include "lab/figures/noise_table.h"

#include "base/atomic_file.h"
#include "lab/figures/report_results.h"

#include <fmt/format.h>

#include <fstream>

namespace nusselt::lab {

namespace {

/// Percentages over roughness and angle.
Table noise_table(const NoiseTableResult& result) {
    Table table = {{"surface", "estimator", "roughness"}};
    for (const double angle : result.table->angles) table[0].push_back(fmt::format("{:g} degrees", angle));
    for (const NoiseRow& row : result.rows) {
        table.push_back({row.surface->name, row.estimator->label, fmt::format("{:g}", row.roughness)});
        for (const Noise& n : row.noise)
            table.back().push_back(fmt::format("{:.2f} / {:.2f} ({:.1f})", 100 * n.in_highlight,
                                               100 * n.on_plane, 100 * n.largest));
    }
    return table;
}

} // namespace

std::string to_text(const NoiseTableResult& result) {
    return fmt::format("{}: {}\n{}\n\n{}\n{}", result.table->name, result.table->source,
                       result.table->description, to_text(noise_table(result)), to_text(result.expectations));
}

Results results_of(const NoiseTableResult& result) {
    ResultTable noise = {"noise",
                         {{"surface"},
                          {"estimator"},
                          {"roughness"},
                          {"angle", "degrees"},
                          {"in_highlight"},
                          {"on_plane"},
                          {"largest"}}};
    for (const NoiseRow& row : result.rows)
        for (std::size_t i = 0; i < row.noise.size(); ++i)
            noise.rows.push_back({row.surface->name, row.estimator->label, row.roughness,
                                  result.table->angles[i], row.noise[i].in_highlight, row.noise[i].on_plane,
                                  row.noise[i].largest});
    return {result.table->name, {}, {std::move(noise), expectation_table(result.expectations)}};
}

void write_report(const NoiseTableResult& result, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const std::string html = page_head(result.table->name) +
                             fmt::format("<p>{}. {}</p>\n", result.table->source, result.table->description) +
                             to_html(noise_table(result)) + to_html(result.expectations);
    base::write_atomically(folder / "index.html", [&](std::ofstream& file) { file << html; });
    base::write_atomically(folder / "numbers.json",
                           [&](std::ofstream& file) { file << to_json(results_of(result)); });
}

} // namespace nusselt::lab
