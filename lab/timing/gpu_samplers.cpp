#include "lab/timing/gpu_samplers.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <memory>

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

#include "gpu/compute_pipeline.h"
#include "gpu/fused_fma.h"
#include "lab/timing/llvmpipe_threads.h"
#include "lab/timing/sampler_timing_lights.h"
#include "proof/median.h"
#include "proof/quantile.h"
#include "shaders/gpu_samplers_table.h"

namespace nusselt::lab {

namespace {

constexpr std::uint32_t kWorkGroup = 64; // as in shaders/bench/workload.glsl
constexpr std::uint32_t kRepeats = 128;  // lights or samples of each thread
constexpr std::uint32_t kMostGroups = 1 << 15;
constexpr std::size_t kMostColumns = 6 * kLargestVertexCount + 3 + 6; // a polygon and a lobe

/// The lights of a run, with a column for each number of a light.
using Columns = std::vector<float>;

Vec3<float> position(const TimedLights& lights, int light, int j) {
    const auto& v = lights.coordinates[j];
    return {v[0][light], v[1][light], v[2][light]};
}

void add(Columns& columns, std::size_t index, int light, const Vec3<float>& v) {
    const float components[] = {v.x, v.y, v.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns[(index + axis) * kTimedLights + static_cast<std::size_t>(light)] = components[axis];
}

/// \return the number of columns
std::size_t add_polygons(Columns& columns, const TimedLights& lights, int count) {
    const auto n = static_cast<std::size_t>(count);
    for (int i = 0; i < kTimedLights; ++i) {
        Vec3<float> v[kLargestVertexCount];
        for (int j = 0; j < kLargestVertexCount; ++j) v[j] = position(lights, i, j);
        const auto polygon = make_polygon<kLargestVertexCount>(v, count);
        for (std::size_t j = 0; j < n; ++j) {
            add(columns, 3 * j, i, polygon.vertex[j]);
            add(columns, 3 * (n + j), i, polygon.edge[j + 1 < n ? j : kLargestVertexCount - 1]);
        }
        add(columns, 6 * n, i, polygon.normal);
    }
    return 6 * n + 3;
}

/// \copydoc add_polygons
std::size_t add_lines(Columns& columns, const TimedLights& lights) {
    for (int i = 0; i < kTimedLights; ++i) {
        const auto line = make_line(position(lights, i, 0), position(lights, i, 1));
        add(columns, 0, i, line.p0);
        add(columns, 3, i, line.s);
        columns[6 * kTimedLights + static_cast<std::size_t>(i)] = line.length;
    }
    return 7;
}

/// \copydoc add_polygons
std::size_t add_round(Columns& columns, const TimedLights& lights) {
    for (int i = 0; i < kTimedLights; ++i) {
        const Vec3<float> a = position(lights, i, 0), b = position(lights, i, 1), c = position(lights, i, 2),
                          d = position(lights, i, 3);
        const Vec3<float> u = 0.5f * (a - c), v = 0.5f * (b - d);
        add(columns, 0, i, 0.5f * (a + c));
        add(columns, 3, i, u);
        add(columns, 6, i, v);
        add(columns, 9, i, (1 / length(u)) * cross(u, v));
    }
    return 12;
}

void add_column(Columns& columns, std::size_t index, const float (&values)[kTimedLights]) {
    std::copy(std::begin(values), std::end(values),
              columns.begin() + static_cast<std::ptrdiff_t>(index * kTimedLights));
}

/// The columns in the layout that shaders/bench reads.
Columns columns_of(const TimedConfiguration& c, const TimedLights& lights) {
    Columns columns(kMostColumns * kTimedLights);
    std::size_t count = is_polygon(c.kind) ? add_polygons(columns, lights, c.vertex_count)
                        : is_round(c.kind) ? add_round(columns, lights)
                                           : add_lines(columns, lights);
    if (is_cylinder(c.kind)) add_column(columns, count++, lights.radius);
    if (has_lobe(c.kind))
        for (const auto& values : lights.lobe) add_column(columns, count++, values);
    return columns;
}

/// One shader with one workload.
class Workload {
public:
    /// \param fused_fma       as gpu::has_fused_fma() says.
    /// \param lights, samples of each light, in each thread.
    Workload(const gpu::Device& device, const GpuSamplerShader& shader, bool fused_fma, std::uint32_t lights,
             std::uint32_t samples, const gpu::Buffer& columns, const gpu::Buffer& sums)
        : device_(&device),
          pipeline_(device, shader.spirv,
                    {.storage_buffers = 2, .constants = {fused_fma ? 1u : 0u, lights, samples}}) {
        pipeline_.bind({&columns, &sums});
    }

    /// \return time per light or sample [ns]
    double run(std::uint32_t groups) const {
        const double time = device_->time(
            [&](const gpu::Device::Commands& commands) { pipeline_.dispatch(commands, {}, groups); });
        return time / (static_cast<double>(groups) * kWorkGroup * kRepeats);
    }

    /// A number of groups for which the start and the end of a run do not matter. Also warms up the device.
    std::uint32_t calibrated_groups() const {
        constexpr double kEnough = 4e6; // ns
        run(1);                         // a driver may compile the shader now
        std::uint32_t groups = 1;
        while (groups < kMostGroups && shortest_time(groups) < kEnough) groups *= 2;
        return groups;
    }

private:
    /// The shorter one of two runs [ns]: what else the machine does must not look like work of the shader.
    double shortest_time(std::uint32_t groups) const {
        const double first = run(groups);
        return std::min(first, run(groups)) * groups * kWorkGroup * kRepeats;
    }

    const gpu::Device* device_;
    gpu::ComputePipeline pipeline_;
};

/// A shader with both workloads.
struct Timed {
    const GpuSamplerShader* shader;
    Workload lights, samples;
};

/// The measurements for one row.
struct Running {
    const Timed* timed;
    const TimedConfiguration* configuration;
    std::uint32_t light_groups = 0, sample_groups = 0;
    GpuSamplerSeries series;
};

std::optional<double> ratio(double time, double other) {
    if (time > 0 && other > 0) return time / other;
    return std::nullopt;
}

void add_ratios(std::vector<GpuSamplerTiming>& rows) {
    for (GpuSamplerTiming& row : rows)
        for (const GpuSamplerTiming& other : rows) {
            if (other.technique != competitor_of(row.technique) || other.configuration != row.configuration ||
                other.directions)
                continue;
            row.light_ratio = ratio(row.light_ns, other.light_ns);
            row.sample_ratio = ratio(row.sample_ns, other.sample_ns);
        }
}

} // namespace

std::vector<GpuSamplerTiming> rows_of(const std::vector<GpuSamplerSeries>& series) {
    std::vector<GpuSamplerTiming> rows;
    const GpuSamplerSeries* baseline = nullptr;
    for (const GpuSamplerSeries& s : series) {
        if (s.technique == "Baseline") {
            baseline = &s;
            continue;
        }
        assert(baseline != nullptr && baseline->configuration == s.configuration);
        const double light = proof::median(s.light_ns), sample = proof::median(s.sample_ns);
        GpuSamplerTiming row;
        row.technique = s.technique;
        row.configuration = s.configuration;
        row.directions = s.directions;
        row.light_ns = light - proof::median(baseline->light_ns);
        row.sample_ns = sample - proof::median(baseline->sample_ns);
        row.light_spread = proof::half_interquartile_range(s.light_ns) / light;
        row.sample_spread = proof::half_interquartile_range(s.sample_ns) / sample;
        rows.push_back(row);
    }
    add_ratios(rows);
    return rows;
}

GpuSamplerTable time_gpu_samplers(const GpuSamplerSettings& settings) {
    const gpu::Device device({.choice = settings.device});
    const bool fused = gpu::has_fused_fma(device);
    gpu::Buffer columns(device, kMostColumns * kTimedLights * sizeof(float), gpu::Residence::device_local);
    const gpu::Buffer sums(device, std::size_t{kMostGroups} * kWorkGroup * 4 * sizeof(float),
                           gpu::Residence::device_local);

    std::vector<std::unique_ptr<Timed>> all;
    for (const GpuSamplerShader& shader : kGpuSamplerShaders)
        all.push_back(std::make_unique<Timed>(Timed{&shader,
                                                    {device, shader, fused, kRepeats, 1, columns, sums},
                                                    {device, shader, fused, 1, kRepeats, columns, sums}}));
    const std::vector<TimedConfiguration> configurations = timed_configurations();
    const auto lights = std::make_unique<TimedLights>();
    std::vector<Running> all_running;
    for (const TimedConfiguration& c : configurations)
        for (const auto& timed : all)
            if (timed->shader->kind == c.kind && timed->shader->vertex_count == c.vertex_count)
                all_running.push_back(
                    {timed.get(),
                     &c,
                     0,
                     0,
                     {timed->shader->technique, c.name, {}, {}, timed->shader->directions}});

    const auto upload = [&](const TimedConfiguration& c) {
        make_timed_lights(c, 1, *lights);
        columns.write<float>(columns_of(c, *lights));
    };
    for (int repetition = 0; repetition < settings.repetitions; ++repetition) {
        const TimedConfiguration* uploaded = nullptr;
        for (Running& s : all_running) {
            if (s.configuration != uploaded) upload(*s.configuration);
            uploaded = s.configuration;
            if (repetition == 0) {
                s.light_groups = s.timed->lights.calibrated_groups();
                s.sample_groups = s.timed->samples.calibrated_groups();
            }
            s.series.light_ns.push_back(s.timed->lights.run(s.light_groups));
            s.series.sample_ns.push_back(s.timed->samples.run(s.sample_groups));
        }
    }
    std::vector<GpuSamplerSeries> series;
    for (const Running& s : all_running) series.push_back(s.series);
    return {device.description(), device.clock(), fused, llvmpipe_threads(device.description()),
            rows_of(series)};
}

} // namespace nusselt::lab
