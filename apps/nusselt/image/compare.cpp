#include "compare.h"

#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "apps/common/validators.h"
#include "base/atomic_file.h"
#include "base/file_checks.h"
#include "base/json_output.h"
#include "compare_metrics.h"
#include "image/difference.h"
#include "image/io.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace nusselt::app {

namespace {

void check_files(const CompareOptions& options) {
    std::vector<std::filesystem::path> outputs;
    for (const auto& picture :
         {options.difference, options.absolute_difference, options.flip_map, options.hdr_flip_map}) {
        if (!picture) continue;
        image::check_writable_image(*picture);
        outputs.push_back(*picture);
    }
    if (options.json && options.json != "-") {
        base::check_writable(*options.json);
        outputs.emplace_back(*options.json);
    }
    std::vector<std::filesystem::path> inputs = options.images;
    inputs.push_back(options.reference);
    base::check_distinct(outputs, inputs);
    base::check_exist(inputs);
}

void check_size(const std::filesystem::path& path, const image::Image& a, const image::Image& reference,
                const CompareOptions& options) {
    if (a.width == reference.width && a.height == reference.height) return;
    throw std::runtime_error(fmt::format(
        "'{}' has {} x {} pixels, the reference '{}' {} x {}; render both at the same size", path.string(),
        a.width, a.height, options.reference.string(), reference.width, reference.height));
}

/// Values of a picture end at 1, so its difference from an image with radiance is large wherever the radiance is larger.
void warn_of_picture(const std::filesystem::path& path, const std::filesystem::path& reference) {
    const bool has_radiance = image::is_high_dynamic_range(path);
    if (has_radiance == image::is_high_dynamic_range(reference)) return;
    print_message(
        "nusselt compare: '{}' cannot hold values above 1, and '{}' can; compare images of one kind\n",
        (has_radiance ? reference : path).string(), (has_radiance ? path : reference).string());
}

/// \returns the scale of the pictures
double write_differences(const image::Image& a, const image::Image& reference,
                         const CompareOptions& options) {
    const double scale =
        options.difference_scale ? *options.difference_scale : image::difference_scale(a, reference);
    if (options.difference)
        image::write_image(*options.difference, image::signed_difference_image(a, reference, scale));
    if (options.absolute_difference) {
        image::write_image(*options.absolute_difference,
                           image::absolute_difference_image(a, reference, scale));
    }
    return scale;
}

/// \returns whether all limits are kept
bool compare_images(const CompareOptions& options) {
    check_files(options);
    const image::Image reference = image::read_image(options.reference);
    std::vector<ComparedImage> compared;
    std::string scale_text;
    for (const std::filesystem::path& path : options.images) {
        const image::Image a = image::read_image(path);
        check_size(path, a, reference, options);
        warn_of_picture(path, options.reference);
        compared.push_back(measure(path, a, reference, options));
        if (options.difference || options.absolute_difference) {
            scale_text = fmt::format("{:<19}{:.9g} in full colour\n", "difference scale",
                                     write_differences(a, reference, options));
        }
    }
    const std::vector<BrokenLimit> broken = broken_limits(compared, options);
    // Paths may hold bytes that are not UTF-8.
    const std::string json = json_of(compared, broken, reference, options)
                                 .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
                             "\n";
    if (options.json != "-") {
        print_metrics(compared);
        fmt::print("{}", scale_text);
    }
    if (options.json) base::write_json(*options.json, json);
    for (const BrokenLimit& limit : broken) {
        print_message("nusselt compare: '{}': {} is {:.9g}, {} the limit of {:.9g}\n", limit.image,
                      limit.metric, limit.value, limit.relation, limit.limit);
    }
    return broken.empty();
}

/// \throws CLI::ValidationError
MetricLimit parsed_limit(const std::string& option, const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string metric = text.substr(0, equals);
    const auto& names = metric_names();
    if (equals == std::string::npos || std::find(names.begin(), names.end(), metric) == names.end()) {
        throw CLI::ValidationError(option, fmt::format("'{}' must be METRIC=VALUE with one of the metrics {}",
                                                       text, fmt::join(names, ", ")));
    }
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [parsed_end, error] = std::from_chars(text.data() + equals + 1, end, value);
    if (error != std::errc() || parsed_end != end || !std::isfinite(value))
        throw CLI::ValidationError(option, fmt::format("'{}' needs a finite number after '='", text));
    return {metric, value};
}

/// The arguments on the command line, before they are checked as a whole.
struct Arguments {
    CompareOptions options;
    std::vector<std::filesystem::path> paths; ///< the last one is the reference
    std::optional<std::string> metrics;
    std::vector<std::string> at_most, at_least;
};

/// \throws CLI::ValidationError
CompareOptions checked_options(const Arguments& arguments) {
    CompareOptions options = arguments.options;
    options.images = {arguments.paths.begin(), arguments.paths.end() - 1};
    options.reference = arguments.paths.back();
    for (const std::string& text : arguments.at_most) options.at_most.push_back(parsed_limit("--max", text));
    for (const std::string& text : arguments.at_least)
        options.at_least.push_back(parsed_limit("--min", text));
    if (!arguments.metrics) {
        options.metrics = default_metric_names();
    } else if (arguments.metrics == "all") {
        options.metrics = metric_names();
    } else if (arguments.metrics->empty()) {
        throw CLI::ValidationError("--metrics", fmt::format("needs the name of a metric; use {}, or all",
                                                            fmt::join(metric_names(), ", ")));
    } else {
        options.metrics = CLI::detail::split(*arguments.metrics, ',');
    }
    for (const std::string& name : options.metrics) {
        if (std::find(metric_names().begin(), metric_names().end(), name) != metric_names().end()) continue;
        throw CLI::ValidationError("--metrics", fmt::format("unknown metric '{}'; use {}, or all", name,
                                                            fmt::join(metric_names(), ", ")));
    }
    const bool has_picture =
        options.difference || options.absolute_difference || options.flip_map || options.hdr_flip_map;
    if (options.difference_scale && !options.difference && !options.absolute_difference)
        throw CLI::ValidationError("--diff-scale needs --diff or --abs-diff");
    if (options.images.size() > 1 && has_picture)
        throw CLI::ValidationError("difference pictures are supported for a single IMAGE only");
    return options;
}

constexpr const char* kDescription =
    "Compare images with a reference of the same size, which is the last argument. One image is reported as "
    "a list, several as a table. Averages exclude pixels that are NaN or infinite in either image; these "
    "pixels are listed. Metrics (docs/images.md has the formulas):\n"
    "  mse, rmse       mean squared error and its root\n"
    "  relative_rmse   rmse / mean of the reference\n"
    "  mae             mean absolute error\n"
    "  rel_mse         mean of (A - B)^2 / (B^2 + 0.01) over channels\n"
    "  mrse            mean of |A - B|^2 / (|B|^2 + 0.01) over pixels\n"
    "  psnr, ssim      of the images as displayed: times 2^exposure, in [0, 1], sRGB; psnr in dB\n"
    "  flip            mean of FLIP of the displayed images\n"
    "  hdr_flip        mean of HDR-FLIP, over all exposures that show something of the reference\n"
    "  invalid         number of pixels of the image that are NaN or infinite\n"
    "Exits with 0 upon success, with 1 if a file cannot be read or written or sizes differ, and with 3 if "
    "a limit of --max or --min is broken; each broken limit is a line on the standard error output.";

constexpr const char* kJsonDescription =
    "Write the numbers as JSON to a file, or with - to the standard output in place of the plain text: "
    "reference, width, height, exposure, pixels_per_degree, rel_mse_epsilon, invalid_reference, images "
    "(an array with image, each metric by its name, mean_image, mean_reference, compared_pixels and "
    "invalid_image) and broken_limits (image, metric, value, limit). Invalid pixels have count, nan_count "
    "and the first ten (x, y, rgb). NaN and infinities are strings";

constexpr const char* kPicturesGroup = "Pictures";

/// Adds an option for a picture to write.
void add_picture_option(CLI::App& command, const char* name, std::optional<std::filesystem::path>& picture,
                        const char* description) {
    command.add_option(name, picture, description)
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kPicturesGroup);
}

void add_picture_options(CLI::App& command, CompareOptions& options) {
    add_picture_option(
        command, "--diff", options.difference,
        "Write the signed difference IMAGE - REFERENCE in false colours (blue: too dark, white: equal, "
        "red: too bright, black: NaN or infinite): .png, .exr, .hdr or .pfm");
    add_picture_option(command, "--abs-diff", options.absolute_difference,
                       "Write the absolute difference of each channel");
    command.add_option("--diff-scale", options.difference_scale, "Difference shown in full colour")
        ->check(number_above_zero(std::numeric_limits<double>::max()))
        ->default_str("99th percentile over the pixels of the largest difference among the channels")
        ->group(kPicturesGroup);
    add_picture_option(command, "--flip-map", options.flip_map,
                       "Write FLIP of each pixel, from black (0) over purple, red and orange to yellow (1)");
    add_picture_option(command, "--hdr-flip-map", options.hdr_flip_map,
                       "Write HDR-FLIP of each pixel in the same colours");
}

/// Adds --max or --min. \param relation of values that break the limit
void add_limit_option(CLI::App& command, const char* name, std::vector<std::string>& limits,
                      const char* relation) {
    command
        .add_option(
            name, limits,
            fmt::format("Exit with 3 if the metric of an image is {} VALUE or undefined. May be repeated",
                        relation))
        ->type_name("METRIC=VALUE")
        ->allow_extra_args(false)
        ->default_str(kNone);
}

} // namespace

void setup_compare(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<Arguments>();
    CompareOptions& options = arguments->options;
    CLI::App* command = app.add_subcommand("compare", kDescription);
    command
        ->add_option(
            "IMAGES", arguments->paths,
            "IMAGE... REFERENCE: .exr, .hdr, .pfm, or .png, .jpg, .tga (converted to linear); at most "
            "2^28 pixels each")
        ->required()
        ->expected(2, 10000);
    command->add_option("--metrics", arguments->metrics, "Metrics, separated by commas, or all")
        ->type_name("NAME,...")
        ->default_str("all but flip and hdr_flip, which are slow for large images");
    command
        ->add_option("--exposure", options.exposure,
                     "Brighten images by this many stops for psnr, ssim and flip")
        ->check(exposure());
    command
        ->add_option("--ppd", options.pixels_per_degree,
                     "Pixels per degree of the field of vision, for flip and hdr_flip")
        ->check(number_above_zero(image::kFlipMaxPixelsPerDegree))
        ->default_str("67.02, a screen of 3840 pixels seen at a distance of its width");
    add_limit_option(*command, "--max", arguments->at_most, "above");
    add_limit_option(*command, "--min", arguments->at_least, "below");
    add_picture_options(*command, options);
    command->add_option("--json", options.json, kJsonDescription)
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kOutputGroup);
    command->callback([arguments, &exit_code] { exit_code = run_compare(checked_options(*arguments)); });
}

int run_compare(const CompareOptions& options) {
    constexpr int kBrokenLimit = 3;
    return compare_images(options) ? 0 : kBrokenLimit;
}

} // namespace nusselt::app
