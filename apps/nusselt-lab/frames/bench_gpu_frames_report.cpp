#include "bench_gpu_frames_report.h"

#include "apps/nusselt-lab/bench/bench_device.h"

#include "proof/median.h"
#include "proof/quantile.h"

#include <fmt/core.h>

namespace nusselt::app {

namespace {

using proof::median;

/// Half the interquartile range over the median.
double spread_of(const std::vector<double>& values) {
    return proof::half_interquartile_range(values) / median(values);
}

/// The name is empty where a single technique leaves nothing to weigh.
std::string heuristic_of(const render::RenderSettings& settings) {
    if (settings.strategies == render::Strategies::diffuse) return "";
    return std::string(name_of(settings.mis));
}

bool is_software(const GpuFrameTable& table) { return table.device.is_software; }

/// A remark on the device without which the numbers would mislead; may be empty.
std::string remark_of(const GpuFrameTable& table) {
    if (is_software(table)) return "; a software device: the times are those of a processor, not of a GPU";
    if (table.clock == gpu::Clock::wall)
        return "; the device has no timestamps: times include submission and waiting";
    return "";
}

/// Rows with the same scene and the same shadow rays share a heading.
bool begins_block(const std::vector<GpuFrameRow>& rows, std::size_t i) {
    return i == 0 || rows[i].scene != rows[i - 1].scene || rows[i].shadow_rays != rows[i - 1].shadow_rays;
}

void print_rows(const std::vector<GpuFrameRow>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const GpuFrameRow& row = rows[i];
        if (begins_block(rows, i))
            fmt::print(
                "\n{}, {} x {}, shadow rays: {}\n{:<30}{:<14}{:<17}{:>8}{:>13}{:>12}{:>10}{:>10}{:>8}\n",
                row.scene, row.width, row.height, name_of(row.shadow_rays), "technique", "strategies",
                "heuristic", "samples", "shadow rays", "visibility", "shading", "frame", "spread");
        fmt::print("{:<30}{:<14}{:<17}{:>8}{:>13}{:>12.3f}{:>10.3f}{:>10.3f}{:>7.0f}%\n",
                   name_of(row.settings.technique), name_of(row.settings.strategies),
                   heuristic_of(row.settings), row.settings.samples, row.times.shadow_rays,
                   1e3 * median(row.times.visibility), 1e3 * median(row.times.shading),
                   1e3 * median(row.times.whole()), 100 * spread_of(row.times.whole()));
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

void print_sample_times(const std::vector<GpuSampleTime>& times) {
    if (times.empty()) return;
    fmt::print("\nOne more sample per pixel and light takes this many ms more; in a frame of 1920 x 1080 "
               "pixels with one light of the paper, {}.\n{:<24}{:<8}{:<56}{:>8}{:>8}\n",
               1e3 * lab::kPublishedSampleTime, "scene", "shadows", "of", "lights", "frame");
    for (const GpuSampleTime& time : times)
        fmt::print("{:<24}{:<8}{:<56}{:>8}{:>8.3f}\n", time.scene, name_of(time.shadow_rays), time.settings,
                   time.lights, 1e3 * time.seconds);
}

lab::ResultTable frame_table(const std::vector<GpuFrameRow>& rows) {
    lab::ResultTable table = {"frames",
                              {{"scene"},
                               {"width"},
                               {"height"},
                               {"shadow_ray_tracing"},
                               {"technique"},
                               {"strategies"},
                               {"mis"},
                               {"samples"},
                               {"shadow_rays"},
                               {"visibility_ms", "ms"},
                               {"shading_ms", "ms"},
                               {"frame_ms", "ms"},
                               {"spread"}}};
    const auto milliseconds = [](const std::vector<double>& seconds) { return 1e3 * median(seconds); };
    for (const GpuFrameRow& row : rows)
        table.rows.push_back({row.scene, row.width, row.height, std::string(name_of(row.shadow_rays)),
                              std::string(name_of(row.settings.technique)),
                              std::string(name_of(row.settings.strategies)), heuristic_of(row.settings),
                              row.settings.samples, row.times.shadow_rays, milliseconds(row.times.visibility),
                              milliseconds(row.times.shading), milliseconds(row.times.whole()),
                              spread_of(row.times.whole())});
    return table;
}

lab::ResultTable ratio_table(const std::vector<GpuFrameComparison>& comparisons) {
    lab::ResultTable table = {"ratios",
                              {{"scene"},
                               {"shadow_ray_tracing"},
                               {"of"},
                               {"to"},
                               {"frame"},
                               {"shading"},
                               {"shadow_rays"},
                               {"published"}}};
    for (const GpuFrameComparison& c : comparisons) {
        table.rows.push_back({c.scene, std::string(name_of(c.shadow_rays)), c.ours, c.baseline, c.ratio.whole,
                              c.ratio.shading, lab::cell_of(c.ratio.shadow_rays), c.published});
    }
    return table;
}

lab::ResultTable sample_table(const std::vector<GpuSampleTime>& times) {
    lab::ResultTable table = {"additional_samples",
                              {{"scene"},
                               {"width"},
                               {"height"},
                               {"lights"},
                               {"shadow_ray_tracing"},
                               {"of"},
                               {"frame_ms", "ms"},
                               {"published_ms", "ms"}}};
    for (const GpuSampleTime& time : times) {
        const auto published =
            time.is_like_the_published() ? std::optional(1e3 * lab::kPublishedSampleTime) : std::nullopt;
        table.rows.push_back({time.scene, time.width, time.height, time.lights,
                              std::string(name_of(time.shadow_rays)), time.settings, 1e3 * time.seconds,
                              lab::cell_of(published)});
    }
    return table;
}

lab::ResultTable failure_table(const std::vector<GpuFrameFailure>& failures) {
    lab::ResultTable table = {"failures", {{"scene"}, {"message"}}};
    for (const GpuFrameFailure& failure : failures) table.rows.push_back({failure.scene, failure.message});
    return table;
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
    fmt::print("ms, medians of {} interleaved frames after {} to warm up; samples of each technique, per "
               "pixel and light in one frame\n",
               table.rounds.repetitions, table.rounds.warm_up);
    print_rows(table.rows);
    print_comparisons(table.comparisons);
    print_sample_times(table.sample_times);
}

lab::Results results_of(const GpuFrameTable& table) {
    lab::Results results = {"gpu", device_settings(table.device, table.clock, table.llvmpipe_threads), {}};
    results.settings.insert(results.settings.end(), {{"software", is_software(table)},
                                                     {"frames", table.rounds.repetitions},
                                                     {"warm_up", table.rounds.warm_up}});
    results.tables = {frame_table(table.rows), ratio_table(table.comparisons),
                      sample_table(table.sample_times), failure_table(table.failures)};
    return results;
}

} // namespace nusselt::app
