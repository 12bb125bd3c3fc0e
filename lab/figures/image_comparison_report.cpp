#include "lab/figures/run_image_comparison.h"

#include "image/flip.h"

#include <fmt/format.h>

namespace nusselt::lab {

namespace {

Table error_table(const ImageComparisonResult& result) {
    Table table = {{"technique", "RMSE", "clamped at 1", "outside penumbrae / mean", "in penumbrae / mean",
                    "bias / mean", "invalid pixels", "seconds"}};
    for (const VariantResult& v : result.variants)
        table.push_back({v.label, fmt::format("{:.4g}", v.errors.frame.rmse),
                         fmt::format("{:.4g}", v.errors.frame.rmse_clamped),
                         fmt::format("{:.3g}", v.errors.rmse_outside_penumbrae),
                         fmt::format("{:.3g}", v.errors.rmse_in_penumbrae),
                         fmt::format("{:+.1e}", v.errors.frame.relative_bias),
                         fmt::format("{}", v.errors.invalid_pixels),
                         v.seconds ? fmt::format("{:.3f}", *v.seconds) : "-"});
    return table;
}

Table blur_table(const ImageComparisonResult& result) {
    Table table = {
        {fmt::format("after a blur with a standard deviation of {:g} pixels", result.comparison.blur),
         "RMSE / mean"}};
    for (const VariantResult& v : result.variants)
        table.push_back({v.label, fmt::format("{:.3g}", v.errors.rmse_blurred)});
    return table;
}

Table inset_table(const ImageComparisonResult& result) {
    Table table = {{"RMSE in insets (relative to their mean)"}};
    for (const Inset& inset : result.comparison.insets) table[0].push_back(inset.name);
    for (const VariantResult& v : result.variants) {
        table.push_back({v.label});
        for (const RegionErrors& e : v.errors.insets)
            table.back().push_back(fmt::format("{:.4g} ({:.2f} %)", e.rmse, 100 * e.relative_rmse));
    }
    return table;
}

Table bias_table(const ImageComparisonResult& result) {
    Table table = {{"bias, in standard deviations", "mean of frame", "worst cell", "cells", "chi-square",
                    "pixels beyond 3"}};
    for (const VariantResult& v : result.variants)
        table.push_back({v.label, fmt::format("{:.1f}", v.bias->frame),
                         fmt::format("{:.1f}", v.bias->largest_cell), fmt::format("{}", v.bias->cells),
                         fmt::format("{:.1f}", v.bias->chi_square),
                         fmt::format("{:.2f} %", 100 * v.bias->pixels_beyond_three)});
    return table;
}

std::vector<Table> tables(const ImageComparisonResult& result) {
    std::vector<Table> all = {error_table(result)};
    if (!result.comparison.insets.empty()) all.push_back(inset_table(result));
    if (result.comparison.blur > 0) all.push_back(blur_table(result));
    if (!result.variants.empty() && result.variants[0].bias) all.push_back(bias_table(result));
    return all;
}

Results numbers_of(const ImageComparisonResult& result) {
    ResultTable errors = {
        "errors",
        {{"variant"}, {"region"}, {"rmse"}, {"rmse_clamped"}, {"relative_rmse"}, {"relative_bias"}}};
    ResultTable variants = {"variants",
                            {{"variant"},
                             {"rmse_outside_penumbrae"},
                             {"rmse_in_penumbrae"},
                             {"rmse_blurred"},
                             {"invalid_pixels"},
                             {"seconds", "s"}}};
    for (const VariantResult& v : result.variants) {
        const auto append = [&](const std::string& region, const RegionErrors& e) {
            errors.rows.push_back(
                {v.label, region, e.rmse, e.rmse_clamped, e.relative_rmse, e.relative_bias});
        };
        append("image", v.errors.frame);
        for (std::size_t i = 0; i < v.errors.insets.size(); ++i)
            append(result.comparison.insets[i].name, v.errors.insets[i]);
        variants.rows.push_back({v.label, v.errors.rmse_outside_penumbrae, v.errors.rmse_in_penumbrae,
                                 result.comparison.blur > 0 ? Cell(v.errors.rmse_blurred) : Cell(nullptr),
                                 v.errors.invalid_pixels, cell_of(v.seconds)});
    }
    return {result.comparison.name,
            {{"mean", result.mean}, {"share_outside_penumbrae", result.share_outside_penumbrae}},
            {std::move(errors), std::move(variants)}};
}

std::string setting(const ImageComparisonResult& result) {
    const ImageComparison& comparison = result.comparison;
    return fmt::format("Reference: {} samples per pixel; mean radiance {:.4g}; {:.1f} % of the pixels lie "
                       "outside penumbrae. {}",
                       comparison.reference_frames * comparison.reference.samples, result.mean,
                       100 * result.share_outside_penumbrae,
                       comparison.frames > 1
                           ? fmt::format("Errors are root mean squares over {} frames.", comparison.frames)
                           : std::string("Errors are those of one frame."));
}

/// The reference and all variants, and the same after the blur if there is one. FLIP is that of the frame that is shown.
std::vector<ReportImage> images(const ImageComparisonResult& result) {
    std::vector<ReportImage> all = {{"reference", ImageRole::reference, result.reference}};
    for (const VariantResult& v : result.variants) {
        const double flip =
            image::mean_of_valid(image::flip(v.image, result.reference), v.image, result.reference);
        all.push_back(
            {v.label, ImageRole::variant, v.image, {{"RMSE", v.errors.frame.rmse}, {"FLIP", flip}}});
    }
    const double blur = result.comparison.blur;
    if (blur > 0) {
        all.push_back({"reference, blurred", ImageRole::reference, blurred(result.reference, blur)});
        for (const VariantResult& v : result.variants)
            all.push_back({v.label + ", blurred",
                           ImageRole::variant,
                           blurred(v.image, blur),
                           {{"RMSE / mean", v.errors.rmse_blurred}}});
    }
    return all;
}

/// Whether no pixel of the renderer's images is NaN or infinite. Published methods may have such pixels.
ExpectationResult check_validity(const ImageComparisonResult& result) {
    std::int64_t invalid = 0;
    for (std::size_t i = 0; i < result.variants.size(); ++i)
        if (result.comparison.variants[i].technique.empty())
            invalid += result.variants[i].errors.invalid_pixels;
    return checked("no pixel of the renderer is NaN or infinite", invalid == 0);
}

} // namespace

Report report_of(const ImageComparisonResult& result) {
    Report report = {setting(result), tables(result), result.expectations};
    report.expectations.push_back(check_validity(result));
    report.images = images(result);
    report.insets = result.comparison.insets;
    report.numbers = numbers_of(result);
    report.inputs = result.files;
    return report;
}

} // namespace nusselt::lab
