#include "lab/figures/noise_table.h"

#include <fmt/format.h>

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

Results numbers_of(const NoiseTableResult& result) {
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
    return {result.table->name, {}, {std::move(noise)}};
}

} // namespace

Report report_of(const NoiseTableResult& result) {
    Report report = {"", {noise_table(result)}, result.expectations};
    report.numbers = numbers_of(result);
    return report;
}

} // namespace nusselt::lab
