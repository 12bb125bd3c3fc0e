#include "lab/timing/sampler_timing.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "base/isa.h"
#include "base/stopwatch.h"
#include "lab/timing/sampler_timing_lights.h"

namespace nusselt::lab {

namespace {

std::vector<TimedTechnique> techniques_for(base::Isa isa) {
    return base::dispatch(isa, []<base::Isa chosen> { return timed_techniques<chosen>(); });
}

const std::string kBaseline = "Baseline";

using Times = std::vector<double>; ///< per light or sample [ns], including the baseline

/// The measurements for one row.
struct Series {
    const TimedTechnique* technique;
    const TimedConfiguration* configuration;
    Times prepare, world, sample, direction;
};

double nanoseconds_per_light(float (*run)()) {
    // Runs are repeated because the resolution of the clock would matter for short ones.
    constexpr int kRepetitions = 4;
    static volatile float sink;
    sink = run(); // brings code and data into caches
    const base::Stopwatch stopwatch;
    for (int i = 0; i < kRepetitions; ++i) sink = run();
    const double seconds = stopwatch.seconds();
    (void)sink;
    return 1e9 * seconds / (kRepetitions * kTimedLights);
}

void measure(float (*run)(), Times& times) {
    if (run != nullptr) times.push_back(nanoseconds_per_light(run));
}

/// The median without that of the baseline.
std::optional<double> cost(const Times& times, const Times& baseline) {
    if (times.empty()) return std::nullopt;
    return quantile(times, 0.5) - quantile(baseline, 0.5);
}

std::optional<double> spread(const Times& times) {
    if (times.empty()) return std::nullopt;
    return (quantile(times, 0.75) - quantile(times, 0.25)) / 2;
}

std::optional<double> ratio(const std::optional<double>& a, const std::optional<double>& b) {
    if (a && b && *a > 0 && *b > 0) return *a / *b;
    return std::nullopt;
}

/// The class of lights of a row with 4 vertices, for one with another number of them.
std::string with_four_vertices(const std::string& configuration) {
    const auto comma = configuration.rfind(", ");
    return comma == std::string::npos ? "" : configuration.substr(0, comma) + ", 4 vertices";
}

} // namespace

std::string name_of_code(int lanes) {
    return lanes == 1 ? "scalar" : "packs of " + std::to_string(lanes) + ", per lane";
}

std::vector<SamplerTiming> time_samplers(const SamplerTimingSettings& settings) {
    const base::Isa isa = base::choose_isa(settings.isa);
    const std::vector<TimedTechnique> techniques = techniques_for(isa);
    const std::vector<TimedConfiguration> all_configurations = timed_configurations();
    const std::vector<std::string>& wanted = settings.techniques;
    const auto is_wanted = [&](const std::string& name) {
        return wanted.empty() || name == kBaseline ||
               std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    };
    std::vector<Series> series;
    for (const TimedConfiguration& c : all_configurations)
        for (const TimedTechnique& t : techniques)
            if (t.kind == c.kind && t.vertex_count == c.vertex_count && is_wanted(t.name))
                series.push_back({&t, &c, {}, {}, {}, {}});

    const auto lights = std::make_unique<TimedLights>();
    for (int repetition = 0; repetition < settings.repetitions; ++repetition)
        for (Series& s : series) {
            make_timed_lights(*s.configuration, *lights);
            s.technique->load(*lights);
            measure(s.technique->prepare, s.prepare);
            measure(s.technique->prepare_from_world, s.world);
            measure(s.technique->sample, s.sample);
            measure(s.technique->direction, s.direction);
        }

    std::vector<SamplerTiming> rows;
    std::map<int, const Series*> baseline; // by number of lanes; precedes its techniques
    for (const Series& s : series) {
        if (s.technique->name == kBaseline) {
            baseline[s.technique->lanes] = &s;
            continue;
        }
        const Series& b = *baseline.at(s.technique->lanes);
        SamplerTiming row;
        row.technique = s.technique->name;
        row.configuration = s.configuration->name;
        row.code = name_of_code(s.technique->lanes);
        row.isa = name_of(isa);
        row.prepare_ns = cost(s.prepare, b.prepare);
        row.world_ns = cost(s.world, b.world);
        row.sample_ns = cost(s.sample, b.sample);
        row.prepare_spread_ns = spread(s.prepare);
        row.sample_spread_ns = spread(s.sample);
        row.direction_ns = cost(s.direction, b.direction);
        rows.push_back(row);
    }
    return rows;
}

void add_ratios(std::vector<SamplerTiming>& rows) {
    using Key = std::pair<std::string, std::string>;
    std::map<std::pair<Key, std::string>, const SamplerTiming*> row_of;
    for (const SamplerTiming& row : rows) row_of[{{row.technique, row.configuration}, row.code}] = &row;
    const auto find = [&](const std::string& technique, const std::string& lights, const std::string& code) {
        const auto found = row_of.find({{technique, lights}, code});
        return found == row_of.end() ? nullptr : found->second;
    };
    for (SamplerTiming& row : rows) {
        const SamplerTiming* const other = find(competitor_of(row.technique), row.configuration, row.code);
        if (other == nullptr) continue;
        row.prepare_ratio = ratio(row.prepare_ns, other->prepare_ns);
        row.sample_ratio = ratio(row.sample_ns, other->sample_ns);
        row.world_ratio = ratio(row.world_ns, other->world_ns);
        row.once_ratio = ratio(row.once_ns, other->once_ns);
        row.prepare_instructions_ratio = ratio(row.prepare_instructions, other->prepare_instructions);
        row.sample_instructions_ratio = ratio(row.sample_instructions, other->sample_instructions);
    }
    for (SamplerTiming& row : rows) {
        const SamplerTiming* const four =
            find(row.technique, with_four_vertices(row.configuration), row.code);
        if (four == nullptr || four == &row) continue;
        row.prepare_growth = ratio(row.prepare_ratio, four->prepare_ratio);
        row.sample_growth = ratio(row.sample_ratio, four->sample_ratio);
    }
}

} // namespace nusselt::lab
