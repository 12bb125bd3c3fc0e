#include "lab/timing/sampler_timing.h"

#include <map>
#include <memory>

#include "base/isa.h"
#include "base/stopwatch.h"
#include "lab/timing/sampler_timing_lights.h"

namespace nusselt::lab {

namespace {

std::vector<TimedTechnique> techniques_for(base::Isa isa) {
    return base::dispatch(isa, []<base::Isa chosen> { return timed_techniques<chosen>(); });
}

/// The measurements for one row.
struct Series {
    const TimedTechnique* technique;
    const TimedConfiguration* configuration;
    std::vector<double> prepare_ns, sample_ns, sample_one_ns; ///< per light or sample, including the baseline
};

double nanoseconds_per_light(float (*run)()) {
    // Runs are repeated because the resolution of the clock would matter for short ones.
    constexpr int kRepetitions = 4;
    static volatile float sink;
    const base::Stopwatch stopwatch;
    for (int i = 0; i < kRepetitions; ++i) sink = run();
    const double seconds = stopwatch.seconds();
    (void)sink;
    return 1e9 * seconds / (kRepetitions * kTimedLights);
}

void add_ratios(std::vector<SamplerTiming>& rows) {
    for (SamplerTiming& row : rows)
        for (const SamplerTiming& other : rows) {
            if (other.technique != competitor_of(row.technique) || other.configuration != row.configuration)
                continue;
            row.prepare_ratio = row.prepare_ns / other.prepare_ns;
            row.sample_ratio = row.sample_ns / other.sample_ns;
        }
}

} // namespace

std::vector<SamplerTiming> time_samplers(const SamplerTimingSettings& settings) {
    const base::Isa isa = base::choose_isa(settings.isa);
    const std::vector<TimedTechnique> techniques = techniques_for(isa);
    const std::vector<TimedConfiguration> all_configurations = timed_configurations();
    std::vector<Series> series;
    for (const TimedConfiguration& c : all_configurations)
        for (const TimedTechnique& t : techniques) {
            const int bound = !is_polygon(c.kind) ? 2 : c.vertex_count <= 4 ? 4 : 8;
            if (t.kind == c.kind && t.vertex_bound == bound) series.push_back({&t, &c, {}, {}, {}});
        }

    const auto lights = std::make_unique<TimedLights>();
    for (int repetition = 0; repetition < settings.repetitions; ++repetition)
        for (Series& s : series) {
            make_timed_lights(*s.configuration, *lights);
            s.technique->load(*lights);
            s.technique->prepare();
            s.prepare_ns.push_back(nanoseconds_per_light(s.technique->prepare));
            s.sample_ns.push_back(nanoseconds_per_light(s.technique->sample));
            s.sample_one_ns.push_back(nanoseconds_per_light(s.technique->sample_one));
        }

    std::vector<SamplerTiming> rows;
    std::map<int, const Series*> baseline; // by number of lanes; precedes its techniques
    for (const Series& s : series) {
        if (s.technique->name == std::string("Baseline")) {
            baseline[s.technique->lanes] = &s;
            continue;
        }
        const Series& b = *baseline.at(s.technique->lanes);
        const double median = quantile(s.prepare_ns, 0.5);
        SamplerTiming row;
        row.technique = s.technique->name;
        row.configuration = s.configuration->name;
        row.isa = name_of(isa);
        row.lanes = s.technique->lanes;
        row.prepare_ns = median - quantile(b.prepare_ns, 0.5);
        row.sample_ns = quantile(s.sample_ns, 0.5) - quantile(b.sample_ns, 0.5);
        row.sample_one_ns = quantile(s.sample_one_ns, 0.5) - quantile(b.sample_one_ns, 0.5);
        row.spread = (quantile(s.prepare_ns, 0.75) - quantile(s.prepare_ns, 0.25)) / (2 * median);
        rows.push_back(row);
    }
    add_ratios(rows);
    return rows;
}

} // namespace nusselt::lab
