#include "bench_gpu_frames_report.h"

#include "apps/nusselt-lab/bench/bench_device.h"

#include "lab/timing/sampler_timing_lights.h"
#include "proof/median.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace nusselt::app {

namespace {

using proof::median;

/// Half the interquartile range over the median.
double spread_of(const std::vector<double>& values) {
    return (lab::quantile(values, 0.75) - lab::quantile(values, 0.25)) / 2 / median(values);
}

/// With one technique only there is nothing to weigh.
std::string heuristic_of(const render::RenderSettings& settings) {
    if (settings.strategies == render::Strategies::diffuse) return "";
    return std::string(name_of(settings.mis));
}

bool is_software(const GpuFrameTable& table) { return table.device.is_software; }

/// What the reader of the numbers has to know about the device; empty if there is nothing.
std::string remark_of(const GpuFrameTable& table) {
    if (is_software(table)) return "; a software device: these are times of a processor, not of a GPU";
    if (table.clock == gpu::Clock::wall)
        return "; the device has no timestamps: times are with submission and waiting";
    return "";
}

/// The rows of a scene and way to trace have a heading.
bool begins_block(const std::vector<GpuFrameRow>& rows, std::size_t i) {
    return i == 0 || rows[i].scene != rows[i - 1].scene || rows[i].shadow_rays != rows[i - 1].shadow_rays;
}

void print_rows(const std::vector<GpuFrameRow>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const GpuFrameRow& row = rows[i];
        if (begins_block(rows, i))
            fmt::print("\n{}, {} x {}, shadow rays: {}\n{:<30}{:<14}{:<17}{:>13}{:>12}{:>10}{:>10}{:>8}\n",
                       row.scene, row.width, row.height, name_of(row.shadow_rays), "technique", "strategies",
                       "heuristic", "shadow rays", "visibility", "shading", "frame", "spread");
        fmt::print("{:<30}{:<14}{:<17}{:>13}{:>12.3f}{:>10.3f}{:>10.3f}{:>7.0f}%\n",
                   name_of(row.settings.technique), name_of(row.settings.strategies),
                   heuristic_of(row.settings), row.times.shadow_rays, 1e3 * median(row.times.visibility),
                   1e3 * median(row.times.shading), 1e3 * median(row.times.whole()),
                   100 * spread_of(row.times.whole()));
    }
}

void print_comparisons(const std::vector<GpuFrameComparison>& comparisons) {
    if (comparisons.empty()) return;
    fmt::print("\n{:<24}{:<8}{:<56}{:>8}{:>10}{:>8}{:>8}\n", "ratios", "shadows", "of / to", "frame",
               "shading", "rays", "paper");
    for (const GpuFrameComparison& c : comparisons) {
        fmt::print("{:<24}{:<8}{:<56}{:>8.2f}{:>10.2f}{:>8}{:>8.2f}\n", c.scene, name_of(c.shadow_rays),
                   c.ours, c.ratio.whole, c.ratio.shading,
                   c.ratio.shadow_rays ? fmt::format("{:.2f}", *c.ratio.shadow_rays) : "-", c.published);
        fmt::print("{:<32}/ {}\n", "", c.baseline);
    }
}

nlohmann::ordered_json json_of(const GpuFrameRow& row) {
    const auto milliseconds = [](const std::vector<double>& seconds) { return 1e3 * median(seconds); };
    return {{"scene", row.scene},
            {"width", row.width},
            {"height", row.height},
            {"shadow_ray_tracing", name_of(row.shadow_rays)},
            {"technique", name_of(row.settings.technique)},
            {"strategies", name_of(row.settings.strategies)},
            {"mis", heuristic_of(row.settings)},
            {"samples", row.settings.samples},
            {"shadow_rays", row.times.shadow_rays},
            {"visibility_ms", milliseconds(row.times.visibility)},
            {"shading_ms", milliseconds(row.times.shading)},
            {"frame_ms", milliseconds(row.times.whole())},
            {"spread", spread_of(row.times.whole())}};
}

nlohmann::ordered_json json_of(const GpuFrameComparison& c) {
    const std::optional<double>& rays = c.ratio.shadow_rays;
    return {{"scene", c.scene},
            {"shadow_ray_tracing", name_of(c.shadow_rays)},
            {"of", c.ours},
            {"to", c.baseline},
            {"frame", c.ratio.whole},
            {"shading", c.ratio.shading},
            {"shadow_rays", rays ? nlohmann::ordered_json(*rays) : nlohmann::ordered_json(nullptr)},
            {"published", c.published}};
}

nlohmann::ordered_json json_of(const GpuFrameFailure& failure) {
    return {{"scene", failure.scene}, {"message", failure.message}};
}

template <class Items>
nlohmann::ordered_json list_of(const Items& items) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& item : items) list.push_back(json_of(item));
    return list;
}

} // namespace

std::string text_of(const render::RenderSettings& settings) {
    std::string text =
        std::string(name_of(settings.technique)) + ", " + std::string(name_of(settings.strategies));
    if (const std::string heuristic = heuristic_of(settings); !heuristic.empty()) text += ", " + heuristic;
    return text;
}

void print_table(const GpuFrameTable& table) {
    print_device(table.device, table.clock, remark_of(table), text_of_threads(table.llvmpipe_threads));
    fmt::print("ms, medians of {} frames in turn after {} to warm up; two samples of each technique per "
               "pixel and light in one frame\n",
               table.rounds.repetitions, table.rounds.warm_up);
    print_rows(table.rows);
    print_comparisons(table.comparisons);
}

std::string to_json(const GpuFrameTable& table) {
    const nlohmann::ordered_json json = {{"device", table.device.name},
                                         {"kind", table.device.kind},
                                         {"driver", table.device.driver},
                                         {"vulkan", table.device.api_version},
                                         {"clock", text_of_clock(table.clock)},
                                         {"software", is_software(table)},
                                         {"threads", text_of_threads(table.llvmpipe_threads)},
                                         {"frames", table.rounds.repetitions},
                                         {"warm_up", table.rounds.warm_up},
                                         {"rows", list_of(table.rows)},
                                         {"ratios", list_of(table.comparisons)},
                                         {"failures", list_of(table.failures)}};
    // Paths may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace nusselt::app
