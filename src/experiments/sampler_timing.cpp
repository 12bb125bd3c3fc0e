#include "experiments/sampler_timing.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "experiments/sampler_timing_kernel.h"
#include "render_cpu/isa.h"

namespace nusselt::experiments {

namespace {

/// A class of lights in shading space, at a distance of about one.
struct Configuration {
    const char* name;
    LightKind kind;
    int vertex_count;
    double lowest, highest; ///< height of the centre
    double radius;          ///< half the extent of the light
    bool above_zenith;      ///< centred at the zenith
};

constexpr Configuration kConfigurations[] = {
    {"decentral, 3 vertices", LightKind::polygon, 3, 0.5, 0.7, 0.3, false},
    {"decentral, 4 vertices", LightKind::polygon, 4, 0.5, 0.7, 0.3, false},
    {"decentral, 5 vertices", LightKind::polygon, 5, 0.5, 0.7, 0.3, false},
    {"decentral, 7 vertices", LightKind::polygon, 7, 0.5, 0.7, 0.3, false},
    {"central, 4 vertices", LightKind::polygon, 4, 1.0, 1.0, 0.5, true},
    {"crossing the horizon, 4 vertices", LightKind::polygon, 4, -0.1, 0.1, 0.4, false},
    {"above the horizon", LightKind::line, 2, 0.5, 0.7, 0.4, false},
    {"crossing the horizon", LightKind::line, 2, -0.1, 0.1, 0.4, false},
};

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

TimedTechniques techniques_for(render_cpu::Isa isa) {
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
    std::vector<double> prepare_ns, sample_ns; ///< per light or sample, with the baseline
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

} // namespace

std::vector<SamplerTiming> time_samplers(const SamplerTimingSettings& settings) {
    const render_cpu::Isa isa = render_cpu::choose_isa(settings.isa);
    const TimedTechniques techniques = techniques_for(isa);
    std::vector<Series> series;
    for (const Configuration& c : kConfigurations)
        for (int i = 0; i < techniques.count; ++i) {
            const TimedTechnique& t = techniques.begin[i];
            const int bound = c.kind == LightKind::line ? 2 : c.vertex_count <= 4 ? 4 : 8;
            if (t.kind == c.kind && t.vertex_bound == bound) series.push_back({&t, &c, {}, {}});
        }

    const auto lights = std::make_unique<TimedLights>();
    for (int repetition = 0; repetition < settings.repetitions; ++repetition)
        for (Series& s : series) {
            make_lights(*s.configuration, *lights);
            s.technique->load(*lights);
            s.technique->prepare();
            s.prepare_ns.push_back(nanoseconds_per_light(s.technique->prepare));
            s.sample_ns.push_back(nanoseconds_per_light(s.technique->sample));
        }

    std::vector<SamplerTiming> rows;
    const Series* baseline[2] = {};
    for (const Series& s : series) {
        const bool packs = s.technique->lanes > 1;
        if (s.technique->name == std::string("Baseline")) {
            baseline[packs] = &s;
            continue;
        }
        const Series& b = *baseline[packs];
        const double median = quantile(s.prepare_ns, 0.5);
        rows.push_back({s.technique->name, s.configuration->name, std::string(name_of(isa)),
                        s.technique->lanes, median - quantile(b.prepare_ns, 0.5),
                        quantile(s.sample_ns, 0.5) - quantile(b.sample_ns, 0.5),
                        (quantile(s.prepare_ns, 0.75) - quantile(s.prepare_ns, 0.25)) / (2 * median)});
    }
    return rows;
}

} // namespace nusselt::experiments
