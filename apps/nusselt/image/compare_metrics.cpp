#include "compare_metrics.h"

#include "image/difference.h"
#include "image/io.h"
#include "image/ssim.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace nusselt::app {

namespace {

/// The inputs of a metric.
struct Inputs {
    const image::Image& a;
    const image::Image& reference;
    const image::Comparison& comparison;
    const CompareOptions& options;
};

struct Metric {
    std::string name; ///< in options, tables and JSON
    std::function<double(const Inputs&)> value;
};

/// Writes the map, if a file is asked for. \returns its mean
double finish_map(const image::Plane& map, const std::optional<std::filesystem::path>& file,
                  const Inputs& in) {
    if (file) image::write_image(*file, image::error_map_image(map));
    return image::mean_of_valid(map, in.a, in.reference);
}

double flip_value(const Inputs& in) {
    const CompareOptions& options = in.options;
    return finish_map(image::flip(in.a, in.reference, options.pixels_per_degree, options.exposure),
                      options.flip_map, in);
}

double hdr_flip_value(const Inputs& in) {
    return finish_map(image::hdr_flip(in.a, in.reference, image::flip_exposures(in.reference),
                                      in.options.pixels_per_degree),
                      in.options.hdr_flip_map, in);
}

const std::vector<Metric>& all_metrics() {
    static const std::vector<Metric> metrics = {
        {"mse", [](const Inputs& in) { return in.comparison.mse; }},
        {"rmse", [](const Inputs& in) { return in.comparison.rmse; }},
        {"relative_rmse", [](const Inputs& in) { return in.comparison.relative_rmse; }},
        {"mae", [](const Inputs& in) { return in.comparison.mae; }},
        {"rel_mse", [](const Inputs& in) { return in.comparison.rel_mse; }},
        {"mrse", [](const Inputs& in) { return in.comparison.mrse; }},
        {"psnr", [](const Inputs& in) { return image::psnr(in.a, in.reference, in.options.exposure); }},
        {"ssim", [](const Inputs& in) { return image::ssim(in.a, in.reference, in.options.exposure); }},
        {"flip", flip_value},
        {"hdr_flip", hdr_flip_value},
        {"invalid", [](const Inputs& in) { return double(in.comparison.invalid_a.count); }},
    };
    return metrics;
}

bool is_wanted(const std::string& name, const CompareOptions& options) {
    const auto is_name = [&](const std::string& other) { return other == name; };
    const auto has_name = [&](const MetricLimit& limit) { return limit.metric == name; };
    return std::any_of(options.metrics.begin(), options.metrics.end(), is_name) ||
           std::any_of(options.at_most.begin(), options.at_most.end(), has_name) ||
           std::any_of(options.at_least.begin(), options.at_least.end(), has_name) ||
           (name == "flip" && options.flip_map) || (name == "hdr_flip" && options.hdr_flip_map);
}

std::string text_of(double value) { return std::isnan(value) ? "undefined" : fmt::format("{:.9g}", value); }

void print_invalid_pixels(const std::string& where, const image::InvalidPixels& invalid) {
    if (invalid.count == 0) return;
    fmt::print(
        "{} pixels of {} are invalid ({} with NaN, {} only infinite) and excluded from all averages:\n",
        invalid.count, where, invalid.nan_count, invalid.count - invalid.nan_count);
    for (const image::InvalidPixel& pixel : invalid.first)
        fmt::print("  x {} y {}: {} {} {}\n", pixel.x, pixel.y, pixel.rgb[0], pixel.rgb[1], pixel.rgb[2]);
    const std::int64_t not_listed = invalid.count - std::int64_t(invalid.first.size());
    if (not_listed > 0) fmt::print("  and {} more\n", not_listed);
}

void print_list(const ComparedImage& compared) {
    for (const MetricValue& metric : compared.metrics)
        fmt::print("{:<19}{}\n", metric.name, text_of(metric.value));
    fmt::print("{:<19}{}\n", "mean", text_of(compared.comparison.mean_a));
    fmt::print("{:<19}{}\n", "mean of reference", text_of(compared.comparison.mean_b));
}

void print_table(const std::vector<ComparedImage>& images) {
    std::size_t width = 5;
    for (const ComparedImage& compared : images) width = std::max(width, compared.path.string().size());
    fmt::print("{:<{}}", "image", width);
    for (const MetricValue& metric : images.front().metrics) fmt::print("  {:>14}", metric.name);
    fmt::print("  {:>14}\n", "mean");
    for (const ComparedImage& compared : images) {
        fmt::print("{:<{}}", compared.path.string(), width);
        for (const MetricValue& metric : compared.metrics) fmt::print("  {:>14}", text_of(metric.value));
        fmt::print("  {:>14}\n", text_of(compared.comparison.mean_a));
    }
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

std::vector<std::string> names_of(const std::vector<Metric>& metrics) {
    std::vector<std::string> names;
    for (const Metric& metric : metrics) names.push_back(metric.name);
    return names;
}

} // namespace

const std::vector<std::string>& metric_names() {
    static const std::vector<std::string> names = names_of(all_metrics());
    return names;
}

const std::vector<std::string>& default_metric_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result = metric_names();
        std::erase_if(result, [](const std::string& name) { return name == "flip" || name == "hdr_flip"; });
        return result;
    }();
    return names;
}

ComparedImage measure(const std::filesystem::path& path, const image::Image& a, const image::Image& reference,
                      const CompareOptions& options) {
    ComparedImage result = {path, image::compare(a, reference), {}};
    for (const Metric& metric : all_metrics()) {
        if (!is_wanted(metric.name, options)) continue;
        const double value = metric.value({a, reference, result.comparison, options});
        result.metrics.push_back({metric.name, value});
    }
    return result;
}

std::vector<BrokenLimit> broken_limits(const std::vector<ComparedImage>& images,
                                       const CompareOptions& options) {
    std::vector<BrokenLimit> broken;
    for (const ComparedImage& compared : images) {
        for (const MetricValue& metric : compared.metrics) {
            for (const MetricLimit& limit : options.at_most) {
                if (limit.metric == metric.name && !(metric.value <= limit.value))
                    broken.push_back(
                        {compared.path.string(), metric.name, metric.value, limit.value, "above"});
            }
            for (const MetricLimit& limit : options.at_least) {
                if (limit.metric == metric.name && !(metric.value >= limit.value))
                    broken.push_back(
                        {compared.path.string(), metric.name, metric.value, limit.value, "below"});
            }
        }
    }
    return broken;
}

void print_metrics(const std::vector<ComparedImage>& images) {
    if (images.size() == 1) {
        print_list(images.front());
    } else {
        print_table(images);
    }
    for (const ComparedImage& compared : images)
        print_invalid_pixels("'" + compared.path.string() + "'", compared.comparison.invalid_a);
    print_invalid_pixels("the reference", images.front().comparison.invalid_b);
}

nlohmann::ordered_json json_of(const std::vector<ComparedImage>& images,
                               const std::vector<BrokenLimit>& broken, const image::Image& reference,
                               const CompareOptions& options) {
    auto entries = nlohmann::ordered_json::array();
    for (const ComparedImage& compared : images) {
        nlohmann::ordered_json entry = {{"image", compared.path.string()}};
        for (const MetricValue& metric : compared.metrics) entry[metric.name] = json_number(metric.value);
        entry["mean_image"] = json_number(compared.comparison.mean_a);
        entry["mean_reference"] = json_number(compared.comparison.mean_b);
        entry["compared_pixels"] = compared.comparison.compared_pixels;
        entry["invalid_image"] = json_invalid_pixels(compared.comparison.invalid_a);
        entries.push_back(std::move(entry));
    }
    auto limits = nlohmann::ordered_json::array();
    for (const BrokenLimit& limit : broken) {
        limits.push_back({{"image", limit.image},
                          {"metric", limit.metric},
                          {"value", json_number(limit.value)},
                          {"limit", limit.limit}});
    }
    return {
        {"reference", options.reference.string()},
        {"width", reference.width},
        {"height", reference.height},
        {"exposure", options.exposure},
        {"pixels_per_degree", options.pixels_per_degree},
        {"rel_mse_epsilon", image::kRelativeMseEpsilon},
        {"invalid_reference", json_invalid_pixels(images.front().comparison.invalid_b)},
        {"images", entries},
        {"broken_limits", limits},
    };
}

} // namespace nusselt::app
