#include "lab/gpu_report/report_tables.h"

#include "lab/parity/variant_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>

namespace nusselt::lab {

namespace {

std::string text_of(const Json& row, const char* key) { return row.at(key).get<std::string>(); }

/// Three digits; "-" for null.
std::string number_of(const Json& value) {
    return value.is_number() ? fmt::format("{:.3g}", value.get<double>()) : "-";
}

std::string number_of(const std::optional<double>& value) {
    return value ? fmt::format("{:.2g}", *value) : "-";
}

void keep_largest(std::optional<double>& largest, double value) {
    largest = std::max(largest.value_or(value), value);
}

/// The variants, in the order of columns.
enum Column { any_device, fused, columns };

/// \return `columns` for variants without a column
Column column_of(const Json& row) {
    const std::string variant = text_of(row, "variant");
    if (variant == parity::kVariantNames[0]) return any_device;
    return variant == parity::kVariantNames[1] ? fused : columns;
}

/// The largest ratios of techniques, and of all cases of other subjects together.
std::string ratios_text(const std::vector<Json>& rows) {
    struct Ratios {
        std::optional<double> of[columns];
        std::string where;
    };
    std::vector<std::string> order;
    std::map<std::string, Ratios> cases;
    for (const Json& row : rows) {
        const std::string subject = text_of(row, "subject");
        // Hostile lights have a contract, but no ratio.
        if (row.at("ratio").get<double>() == 0) continue;
        const std::string name = subject == "technique" ? text_of(row, "name") : "all of: " + subject;
        if (cases.count(name) == 0) order.push_back(name);
        Ratios& one = cases[name];
        const double ratio = row.at("ratio").get<double>();
        if (ratio > std::max(one.of[any_device].value_or(0), one.of[fused].value_or(0)))
            one.where = text_of(row, "where");
        keep_largest(one.of[column_of(row) == fused ? fused : any_device], ratio);
    }
    MarkdownTable table(
        {"technique, bound on vertices", "shaders for any device", "for a fused fma", "where"});
    for (const std::string& name : order) {
        const Ratios& one = cases[name];
        table.add({name, number_of(one.of[any_device]), number_of(one.of[fused]), one.where});
    }
    return table.text();
}

/// The largest errors over all classes of lights.
std::string errors_text(const std::vector<Json>& rows) {
    struct Errors {
        std::optional<double> cpp, of[columns];
    };
    std::vector<std::pair<std::string, std::string>> order;
    std::map<std::pair<std::string, std::string>, Errors> all;
    for (const Json& row : rows) {
        if (text_of(row, "subject") != "technique" || column_of(row) == columns) continue;
        const std::pair key(text_of(row, "name"), text_of(row, "quantity"));
        if (all.count(key) == 0) order.push_back(key);
        keep_largest(all[key].cpp, row.at("cpp").get<double>());
        keep_largest(all[key].of[column_of(row)], row.at("device").get<double>());
    }
    MarkdownTable table({"technique, bound on vertices", "error of", "C++", "any device", "fused fma"});
    for (const auto& key : order) {
        const Errors& errors = all[key];
        table.add({key.first, key.second, number_of(errors.cpp), number_of(errors.of[any_device]),
                   number_of(errors.of[fused])});
    }
    return table.text();
}

} // namespace

MarkdownTable::MarkdownTable(const std::vector<std::string>& heads) {
    add(heads);
    for (std::size_t i = 0; i < heads.size(); ++i) text_ += "|---";
    text_ += "|\n";
}

void MarkdownTable::add(const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) {
        text_ += "| ";
        for (const char c : cell) text_ += c == '|' ? "\\|" : std::string(1, c == '\n' ? ' ' : c);
        text_ += " ";
    }
    text_ += "|\n";
}

std::string failures_text(const GpuSteps& steps) {
    MarkdownTable table({"step", "what", "message"});
    bool is_empty = true;
    const auto add = [&](const char* step, const std::string& what, const std::string& message) {
        table.add({step, what, message});
        is_empty = false;
    };
    for (const Json& row : rows_of(steps, "parity", "failures"))
        add("parity", text_of(row, "name") + ", " + text_of(row, "variant"), text_of(row, "message"));
    for (const Json& row : rows_of(steps, "agreement", "images"))
        if (!row.at("passes").get<bool>())
            add("agreement",
                text_of(row, "scene") + ", " + text_of(row, "technique") +
                    ", rays: " + text_of(row, "shadow_ray_tracing"),
                fmt::format("{:.2f} % of the pixels differ, {} samples are not finite",
                            100 * row.at("differing_share").get<double>(),
                            row.at("rejected_samples").get<std::uint64_t>()));
    for (const char* step : {"agreement", "frames"})
        for (const Json& row : rows_of(steps, step, "failures"))
            add(step, text_of(row, "scene"), text_of(row, "message"));
    return is_empty ? "" : "\n## Failures\n\n" + table.text();
}

std::string parity_text(const GpuSteps& steps) {
    const std::vector<Json> ratios = rows_of(steps, "parity", "parity");
    if (ratios.empty()) return "";
    return "\n## Errors of GLSL compared with C++\n\n"
           "The largest ratio of an error on the device to that of C++ in float, or to rounding; 3 is "
           "allowed:\n\n" +
           ratios_text(ratios) +
           "\nErrors that 99 % of the lights do not exceed, in the class of lights where they are "
           "largest:\n\n" +
           errors_text(rows_of(steps, "parity", "accuracy"));
}

std::string agreement_text(const GpuSteps& steps) {
    std::vector<std::string> order;
    std::map<std::string, std::map<std::string, std::optional<double>>> shares;
    for (const Json& row : rows_of(steps, "agreement", "images")) {
        const std::string scene = text_of(row, "scene");
        if (shares.count(scene) == 0) order.push_back(scene);
        keep_largest(shares[scene][text_of(row, "shadow_ray_tracing")],
                     100 * row.at("differing_share").get<double>());
    }
    if (order.empty()) return "";
    MarkdownTable table({"scene", "rays by shaders", "ray queries"});
    for (const std::string& scene : order)
        table.add({scene, number_of(shares[scene]["bvh"]), number_of(shares[scene]["query"])});
    return "\n## Images compared with those of the CPU\n\n"
           "The largest share [%] of pixels that differ, over all techniques; 3 % is allowed:\n\n" +
           table.text();
}

std::string samplers_text(const GpuSteps& steps) {
    const std::vector<Json> rows = rows_of(steps, "samplers", "samplers");
    if (rows.empty()) return "";
    MarkdownTable table(
        {"technique", "lights", "light [ns]", "sample [ns]", "light / published", "sample / published"});
    for (const Json& row : rows) {
        const std::string lights = text_of(row, "lights");
        const bool is_shown =
            lights.find("vertices") == std::string::npos || lights.find("4 vertices") != std::string::npos;
        if (is_shown)
            table.add({text_of(row, "technique"), lights, number_of(row.at("light_ns")),
                       number_of(row.at("sample_ns")), number_of(row.at("light_ratio")),
                       number_of(row.at("sample_ratio"))});
    }
    return "\n## Cost of samples\n\n"
           "Per light that is prepared and sampled once, and per further sample, without the loop; and both "
           "over the "
           "published formulas. report.json has polygons with other numbers of vertices, too.\n\n" +
           table.text();
}

std::string frames_text(const GpuSteps& steps) {
    const std::vector<Json> rows = rows_of(steps, "frames", "frames");
    if (rows.empty()) return "";
    MarkdownTable table({"scene", "size", "technique", "strategies", "rays", "visibility [ms]",
                         "shading [ms]", "frame [ms]"});
    for (const Json& row : rows)
        table.add({text_of(row, "scene"),
                   fmt::format("{} x {}", row.at("width").get<int>(), row.at("height").get<int>()),
                   text_of(row, "technique"), text_of(row, "strategies"), text_of(row, "shadow_ray_tracing"),
                   number_of(row.at("visibility_ms")), number_of(row.at("shading_ms")),
                   number_of(row.at("frame_ms"))});
    return "\n## Cost of frames\n\n"
           "Medians; two samples of each technique per pixel and light in one frame.\n\n" +
           table.text();
}

} // namespace nusselt::lab
