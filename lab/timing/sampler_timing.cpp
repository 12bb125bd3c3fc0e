#include "lab/timing/sampler_timing.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "base/isa.h"
#include "base/stopwatch.h"
#include "lab/timing/sampler_loops.h"
#include "lab/timing/sampler_timing_lights.h"
#include "proof/median.h"
#include "proof/quantile.h"

namespace nusselt::lab {

namespace {

const std::string kBaseline = "Baseline";

/// Of one light, as in the papers.
constexpr int kSamples = 128;
/// Groups of lights of which many samples are taken.
constexpr int kSampledGroups = 16;

using Times = std::vector<double>; ///< per light or sample [ns], including the baseline

/// The measurements for one row.
struct Series {
    const TimedTechnique* technique;
    const TimedConfiguration* configuration;
    Times prepare, world, once, sample, direction;
};

template <class Run>
double nanoseconds(int count, const Run& run) {
    const base::Stopwatch stopwatch;
    run();
    return 1e9 * stopwatch.seconds() / count;
}

/// Times a loop over the second half of the lights. The first one brings code and tables into caches, but does not teach
/// the branches.
void measure(SamplerLoops& loops, void (SamplerLoops::*loop)(int, int), int groups, int lanes, Times& times) {
    const int half = groups / 2;
    (loops.*loop)(0, half);
    times.push_back(nanoseconds(half * lanes, [&] { (loops.*loop)(half, groups); }));
}

/// Times many samples of each of the first groups of lights.
void measure_samples(SamplerLoops& loops, void (*function)(const void*, const void*, int), int count,
                     int lanes, Times& times) {
    loops.keep(count);
    loops.draw(function, count, 1);
    times.push_back(nanoseconds(count * kSamples * lanes, [&] { loops.draw(function, count, kSamples); }));
}

void measure(Series& s, LoadedLights& lights) {
    const TimedTechnique& t = *s.technique;
    const int sampled = std::min(kSampledGroups, lights.groups);
    SamplerLoops loops(t, lights, sampled);
    measure(loops, &SamplerLoops::prepare, lights.groups, t.lanes, s.prepare);
    measure(loops, &SamplerLoops::once, lights.groups, t.lanes, s.once);
    if (t.transform) measure(loops, &SamplerLoops::prepare_from_world, lights.groups, t.lanes, s.world);
    measure_samples(loops, t.sample, sampled, t.lanes, s.sample);
    if (t.direction) measure_samples(loops, t.direction, sampled, t.lanes, s.direction);
}

/// The median without that of the baseline.
std::optional<double> cost(const Times& times, const Times& baseline) {
    if (times.empty()) return std::nullopt;
    return proof::median(times) - proof::median(baseline);
}

std::optional<double> spread(const Times& times) {
    if (times.empty()) return std::nullopt;
    return proof::half_interquartile_range(times);
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

/// The series that the settings ask for; those of one class of lights stand together.
std::vector<Series> series_of(const SamplerTimingSettings& settings,
                              const std::vector<TimedTechnique>& techniques,
                              const std::vector<TimedConfiguration>& configurations) {
    const auto is_in = [](const std::vector<std::string>& wanted, const std::string& name) {
        return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    };
    std::vector<Series> series;
    for (const TimedConfiguration& c : configurations) {
        if (!is_in(settings.configurations, c.name)) continue;
        for (const TimedTechnique& t : techniques)
            if (t.kind == c.kind && t.vertex_count == c.vertex_count &&
                (t.name == kBaseline || is_in(settings.techniques, t.name)))
                series.push_back({&t, &c, {}, {}, {}, {}, {}});
    }
    return series;
}

} // namespace

std::vector<TimedTechnique> timed_techniques_for(base::Isa isa) {
    std::vector<TimedTechnique> result;
    const auto add = [&](const TimedTechniques& techniques) {
        result.insert(result.end(), techniques.begin, techniques.begin + techniques.count);
    };
    add(base::dispatch(isa, []<base::Isa chosen> { return timed_techniques<chosen>(); }));
    if (isa == base::Isa::avx2) add(timed_techniques_with_other_bounds());
    return result;
}

std::string name_of_code(int lanes) {
    return lanes == 1 ? "scalar" : "packs of " + std::to_string(lanes) + ", per lane";
}

std::vector<SamplerTiming> time_samplers(const SamplerTimingSettings& settings) {
    const base::Isa isa = base::choose_isa(settings.isa);
    const std::vector<TimedTechnique> techniques = timed_techniques_for(isa);
    const std::vector<TimedConfiguration> configurations = timed_configurations();
    std::vector<Series> series = series_of(settings, techniques, configurations);

    const auto lights = std::make_unique<TimedLights>();
    for (int repetition = 0; repetition < settings.repetitions; ++repetition) {
        const TimedConfiguration* made = nullptr;
        std::map<const TimedLightType*, LoadedLights> loaded;
        for (Series& s : series) {
            if (s.configuration != made) {
                made = s.configuration;
                make_timed_lights(*made, static_cast<unsigned>(repetition + 1), *lights);
                loaded.clear();
            }
            const TimedLightType* const type = s.technique->light_type;
            if (loaded.count(type) == 0)
                loaded.emplace(type, LoadedLights(*lights, *type, s.technique->lanes));
            measure(s, loaded.at(type));
        }
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
        row.once_ns = cost(s.once, b.once);
        row.sample_ns = cost(s.sample, b.sample);
        row.prepare_spread_ns = spread(s.prepare);
        row.once_spread_ns = spread(s.once);
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
