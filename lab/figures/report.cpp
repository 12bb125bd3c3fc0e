#include "lab/figures/run.h"

#include "base/atomic_file.h"
#include "image/difference.h"
#include "image/io.h"
#include "lab/figures/report_results.h"
#include "lab/figures/report_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace nusselt::lab {

namespace {

Table error_table(const ExperimentResult& result) {
    Table table = {{"technique", "RMSE", "clamped at 1", "outside penumbrae / mean", "bias / mean",
                    "invalid pixels", "seconds"}};
    for (const VariantResult& v : result.variants)
        table.push_back({v.label, fmt::format("{:.4g}", v.errors.frame.rmse),
                         fmt::format("{:.4g}", v.errors.frame.rmse_clamped),
                         fmt::format("{:.3g}", v.errors.rmse_outside_penumbrae),
                         fmt::format("{:+.1e}", v.errors.frame.relative_bias),
                         fmt::format("{}", v.errors.invalid_pixels), fmt::format("{:.3f}", v.seconds)});
    return table;
}

Table inset_table(const ExperimentResult& result) {
    Table table = {{"RMSE in insets (relative to their mean)"}};
    for (const Inset& inset : result.experiment->insets) table[0].push_back(inset.name);
    for (const VariantResult& v : result.variants) {
        table.push_back({v.label});
        for (const RegionErrors& e : v.errors.insets)
            table.back().push_back(fmt::format("{:.4g} ({:.2f} %)", e.rmse, 100 * e.relative_rmse));
    }
    return table;
}

Table bias_table(const ExperimentResult& result) {
    Table table = {{"bias, in standard deviations", "mean of frame", "worst cell", "cells", "chi-square",
                    "pixels beyond 3"}};
    for (const VariantResult& v : result.variants)
        table.push_back({v.label, fmt::format("{:.1f}", v.bias->frame),
                         fmt::format("{:.1f}", v.bias->largest_cell), fmt::format("{}", v.bias->cells),
                         fmt::format("{:.1f}", v.bias->chi_square),
                         fmt::format("{:.2f} %", 100 * v.bias->pixels_beyond_three)});
    return table;
}

std::vector<Table> tables(const ExperimentResult& result) {
    std::vector<Table> all = {error_table(result)};
    if (!result.experiment->insets.empty()) all.push_back(inset_table(result));
    if (!result.variants.empty() && result.variants[0].bias) all.push_back(bias_table(result));
    return all;
}

std::string figure(const std::string& label, const std::string& file) {
    return fmt::format("<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>\n", file,
                       label);
}

} // namespace

std::string to_text(const ExperimentResult& result) {
    std::string text = fmt::format("{}: {}\n{:.1f} % of the pixels outside penumbrae, mean radiance {:.4g}\n",
                                   result.experiment->name, result.experiment->source,
                                   100 * result.share_outside_penumbrae, result.mean);
    for (const Table& table : tables(result)) text += "\n" + to_text(table);
    return text + "\n" + to_text(result.expectations);
}

Results results_of(const ExperimentResult& result) {
    ResultTable errors = {
        "errors",
        {{"variant"}, {"region"}, {"rmse"}, {"rmse_clamped"}, {"relative_rmse"}, {"relative_bias"}}};
    ResultTable variants = {"variants",
                            {{"variant"}, {"rmse_outside_penumbrae"}, {"invalid_pixels"}, {"seconds", "s"}}};
    for (const VariantResult& v : result.variants) {
        const auto append = [&](const std::string& region, const RegionErrors& e) {
            errors.rows.push_back(
                {v.label, region, e.rmse, e.rmse_clamped, e.relative_rmse, e.relative_bias});
        };
        append("image", v.errors.frame);
        for (std::size_t i = 0; i < v.errors.insets.size(); ++i)
            append(result.experiment->insets[i].name, v.errors.insets[i]);
        variants.rows.push_back(
            {v.label, v.errors.rmse_outside_penumbrae, v.errors.invalid_pixels, v.seconds});
    }
    return {result.experiment->name,
            {{"mean", result.mean}, {"share_outside_penumbrae", result.share_outside_penumbrae}},
            {std::move(errors), std::move(variants), expectation_table(result.expectations)}};
}

void write_report(const ExperimentResult& result, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const Experiment& experiment = *result.experiment;
    std::string html =
        page_head(experiment.name) +
        fmt::format(
            "<p>{}. {} Reference: {} samples per pixel; mean radiance {:.4g}; {:.1f} % of the pixels lie "
            "outside penumbrae.</p>\n",
            experiment.source, experiment.description,
            experiment.reference_frames * result.reference_settings.samples, result.mean,
            100 * result.share_outside_penumbrae);
    for (const Table& table : tables(result)) html += to_html(table);
    html += to_html(result.expectations) + "<h2>Images</h2>\n";

    image::write_image(folder / "reference.exr", result.reference);
    image::write_image(folder / "reference.png", result.reference);
    html += figure("reference", "reference.png");
    double scale = 0;
    for (const VariantResult& v : result.variants)
        scale = std::max(scale, image::difference_scale(v.image, result.reference));
    std::string differences;
    for (const VariantResult& v : result.variants) {
        image::write_image(folder / (v.label + ".exr"), v.image);
        image::write_image(folder / (v.label + ".png"), v.image);
        image::write_image(folder / (v.label + "-difference.png"),
                           image::signed_difference_image(v.image, result.reference, scale));
        html += figure(v.label, v.label + ".png");
        differences += figure(v.label + " minus reference", v.label + "-difference.png");
    }
    html +=
        fmt::format("<h2>Differences</h2>\n<p>Full colour at {:.3g}; blue is too dark, red too bright.</p>\n",
                    scale) +
        differences;
    base::write_atomically(folder / "index.html", [&](std::ofstream& file) { file << html; });
    base::write_atomically(folder / "numbers.json",
                           [&](std::ofstream& file) { file << to_json(results_of(result)); });
}

} // namespace nusselt::lab
