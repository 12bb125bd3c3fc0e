#include "experiments/sampler_timing.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>

#include "experiments/sampler_timing_kernel.h"
#include "render_cpu/isa.h"

namespace nusselt::experiments {

namespace {

/// A class of lights in shading space, at a distance of about one.
struct Configuration {
    std::string name;
    LightKind kind;
    int vertex_count;
    double lowest, highest; ///< height of the centre
    double radius;          ///< half the extent of the light
    bool above_zenith;      ///< centred at the zenith
};

std::vector<Configuration> configurations() {
    std::vector<Configuration> result;
    for (int n = 3; n <= 7; ++n) {
        const std::string vertices = ", " + std::to_string(n) + " vertices";
        result.push_back({"decentral" + vertices, LightKind::polygon, n, 0.5, 0.7, 0.3, false});
        result.push_back({"central" + vertices, LightKind::polygon, n, 1.0, 1.0, 0.5, true});
        result.push_back({"crossing the horizon" + vertices, LightKind::polygon, n, -0.1, 0.1, 0.4, false});
    }
    result.push_back({"above the horizon", LightKind::line, 2, 0.5, 0.7, 0.4, false});
    result.push_back({"crossing the horizon", LightKind::line, 2, -0.1, 0.1, 0.4, false});
    return result;
}

using Generator = std::mt19937;

/// Regular polygons (or segments) of random orientation; those at the zenith lie flat.
void make_lights(const Configuration& c, TimedLights& lights) {
    Generator generator(1);
    std::uniform_real_distribution<float> uniform(0.0f, 0.9999f);
    std::normal_distribution<double> normal;
    const auto unit = [&](double x, double y, double z) {
        const double r = std::sqrt(x * x + y * y + z * z);
        return std::array{x / r, y / r, z / r};
    };
    for (int i = 0; i < kTimedLights; ++i) {
        const double height = c.lowest + (c.highest - c.lowest) * uniform(generator);
        const double azimuth = 2 * std::numbers::pi * uniform(generator);
        const double side = c.above_zenith ? 0.0 : std::sqrt(1 - height * height);
        const std::array centre{side * std::cos(azimuth), side * std::sin(azimuth), height};
        std::array a = unit(normal(generator), normal(generator), c.above_zenith ? 0 : normal(generator));
        std::array b = unit(normal(generator), normal(generator), normal(generator));
        if (c.above_zenith) b = {-a[1], a[0], 0};
        const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        b = unit(b[0] - along * a[0], b[1] - along * a[1], b[2] - along * a[2]);
        for (int j = 0; j < kLargestVertexCount; ++j) {
            const double angle = 2 * std::numbers::pi * std::min(j, c.vertex_count - 1) / c.vertex_count;
            for (int axis = 0; axis < 3; ++axis)
                lights.coordinates[j][axis][i] = static_cast<float>(
                    centre[axis] + c.radius * (std::cos(angle) * a[axis] + std::sin(angle) * b[axis]));
        }
        for (auto& dimension : lights.u) dimension[i] = uniform(generator);
    }
}

std::vector<TimedTechnique> techniques_for(render_cpu::Isa isa) {
    switch (isa) {
    case render_cpu::Isa::sse42:
        return timed_techniques_sse42();
    case render_cpu::Isa::avx2:
        return timed_techniques_avx2();
    case render_cpu::Isa::avx512:
        break;
    }
    return timed_techniques_avx512();
}

/// One row in the making.
struct Series {
    const TimedTechnique* technique;
    const Configuration* configuration;
    std::vector<double> prepare_ns, sample_ns, sample_one_ns; ///< per light or sample, with the baseline
};

double nanoseconds_per_light(float (*run)()) {
    // Short runs are repeated until the clock's resolution does not matter.
    constexpr int kRepetitions = 4;
    static volatile float sink;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kRepetitions; ++i) sink = run();
    const auto end = std::chrono::steady_clock::now();
    (void)sink;
    return std::chrono::duration<double, std::nano>(end - begin).count() / (kRepetitions * kTimedLights);
}

/// The given share of the sorted values lies below the result.
double quantile(std::vector<double> values, double share) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// The plain transcription that a technique competes with.
std::string competitor_of(const std::string& technique) {
    if (technique == "PolygonProjectedSolidAngleBiased") return "PolygonProjectedSolidAnglePeters";
    return technique + "Peters";
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
    const render_cpu::Isa isa = render_cpu::choose_isa(settings.isa);
    const std::vector<TimedTechnique> techniques = techniques_for(isa);
    const std::vector<Configuration> all_configurations = configurations();
    std::vector<Series> series;
    for (const Configuration& c : all_configurations)
        for (const TimedTechnique& t : techniques) {
            const int bound = c.kind == LightKind::line ? 2 : c.vertex_count <= 4 ? 4 : 8;
            if (t.kind == c.kind && t.vertex_bound == bound) series.push_back({&t, &c, {}, {}, {}});
        }

    const auto lights = std::make_unique<TimedLights>();
    for (int repetition = 0; repetition < settings.repetitions; ++repetition)
        for (Series& s : series) {
            make_lights(*s.configuration, *lights);
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

} // namespace nusselt::experiments
