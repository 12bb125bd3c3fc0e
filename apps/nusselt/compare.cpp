#include "compare.h"

#include "image/atomic_file.h"
#include "image/difference.h"
#include "image/io.h"
#include "image/metrics.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <exception>
#include <memory>
#include <ostream>
#include <string>

namespace nusselt::app {

namespace {

void print_invalid_pixels(const char* label, const image::InvalidPixels& invalid) {
    fmt::print("{:<18}{} pixels", label, invalid.count);
    if (invalid.count > 0) {
        fmt::print(" ({} with NaN, {} only infinite; left out of all averages)", invalid.nan_count,
                   invalid.count - invalid.nan_count);
    }
    fmt::print("\n");
    for (const image::InvalidPixel& pixel : invalid.first)
        fmt::print("  x {} y {}: {} {} {}\n", pixel.x, pixel.y, pixel.rgb[0], pixel.rgb[1], pixel.rgb[2]);
    const std::int64_t not_listed = invalid.count - std::int64_t(invalid.first.size());
    if (not_listed > 0) fmt::print("  and {} more\n", not_listed);
}

void print_text(const image::Comparison& comparison) {
    fmt::print("{:<18}{:.9g}\n", "MSE", comparison.mse);
    fmt::print("{:<18}{:.9g}\n", "RMSE", comparison.rmse);
    fmt::print("{:<18}{:.9g}\n", "RMSE / mean of B", comparison.relative_rmse);
    fmt::print("{:<18}{:.9g}\n", "relMSE", comparison.rel_mse);
    fmt::print("{:<18}{:.9g}\n", "mean of A", comparison.mean_a);
    fmt::print("{:<18}{:.9g}\n", "mean of B", comparison.mean_b);
    print_invalid_pixels("NaN or inf in A", comparison.invalid_a);
    print_invalid_pixels("NaN or inf in B", comparison.invalid_b);
}

/// JSON has no NaN and no infinities, so they appear as text.
nlohmann::ordered_json json_number(double value) {
    if (std::isfinite(value)) return value;
    return fmt::format("{}", value);
}

nlohmann::ordered_json json_invalid_pixels(const image::InvalidPixels& invalid) {
    auto first = nlohmann::ordered_json::array();
    for (const image::InvalidPixel& pixel : invalid.first) {
        first.push_back(
            {{"x", pixel.x},
             {"y", pixel.y},
             {"rgb", {json_number(pixel.rgb[0]), json_number(pixel.rgb[1]), json_number(pixel.rgb[2])}}});
    }
    return {{"count", invalid.count}, {"nan_count", invalid.nan_count}, {"first", first}};
}

std::string json_text(const CompareOptions& options, const image::Image& a,
                      const image::Comparison& comparison) {
    const nlohmann::ordered_json json = {
        {"image", options.image.string()},
        {"reference", options.reference.string()},
        {"width", a.width},
        {"height", a.height},
        {"mse", json_number(comparison.mse)},
        {"rmse", json_number(comparison.rmse)},
        {"relative_rmse", json_number(comparison.relative_rmse)},
        {"rel_mse", json_number(comparison.rel_mse)},
        {"rel_mse_epsilon", image::kRelativeMseEpsilon},
        {"mean_image", json_number(comparison.mean_a)},
        {"mean_reference", json_number(comparison.mean_b)},
        {"compared_pixels", comparison.compared_pixels},
        {"invalid_image", json_invalid_pixels(comparison.invalid_a)},
        {"invalid_reference", json_invalid_pixels(comparison.invalid_b)},
    };
    // Paths may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void compare_images(const CompareOptions& options) {
    const image::Image a = image::read_image(options.image);
    const image::Image reference = image::read_image(options.reference);
    const image::Comparison comparison = image::compare(a, reference);

    const bool json_replaces_text = options.json == "-";
    if (json_replaces_text) {
        fmt::print("{}", json_text(options, a, comparison));
    } else {
        print_text(comparison);
    }
    if (options.json && !json_replaces_text) {
        image::write_atomically(*options.json,
                                [&](std::ostream& stream) { stream << json_text(options, a, comparison); });
    }
    if (options.difference) {
        const double scale =
            options.difference_scale ? *options.difference_scale : image::difference_scale(a, reference);
        image::write_image(*options.difference, image::signed_difference_image(a, reference, scale));
        if (!json_replaces_text)
            fmt::print("{:<18}{:.9g} in full blue (A darker) or red (A brighter)\n", "difference scale",
                       scale);
    }
}

} // namespace

void setup_compare(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand(
        "compare",
        fmt::format(
            "Compare an image A with a reference B: MSE, RMSE, RMSE relative to the mean of B, relMSE\n"
            "(mean of (A - B)^2 / (B^2 + {})), means, and where pixels are NaN or infinite. Such pixels\n"
            "are left out of all averages. Exits with 0, or with 1 if a file cannot be read or written\n"
            "or the sizes differ.",
            image::kRelativeMseEpsilon));
    command
        ->add_option("A", options->image,
                     "Image: .exr, .hdr, or .png, .jpg, .tga (made linear); at most 2^28 pixels")
        ->required();
    command->add_option("B", options->reference, "Reference of the same size, formats as for A")->required();
    CLI::Option* difference = command->add_option(
        "--diff", options->difference,
        "Write the signed difference A - B in false colours (blue: A is darker, white: equal, red: A is\n"
        "brighter, black: NaN or infinite): .png, .exr or .hdr. Default: none");
    command
        ->add_option("--diff-scale", options->difference_scale,
                     "Difference that gets the full colour, above 0.\n"
                     "Default: 99th percentile of |A - B| over the pixels, largest channel each")
        ->check(CLI::PositiveNumber)
        ->needs(difference);
    command->add_option(
        "--json", options->json,
        "Write the numbers as JSON to a file, or with - to the standard output instead of the\n"
        "plain text. Default: none");
    command->callback([options, &exit_code] { exit_code = run_compare(*options); });
}

int run_compare(const CompareOptions& options) {
    try {
        compare_images(options);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "nusselt compare: {}\n", error.what());
        return 1;
    }
}

} // namespace nusselt::app
