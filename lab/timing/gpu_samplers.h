#pragma once
/// Cost of each technique in GLSL on a GPU (Table 1 of both papers of Peters 2021).

#include "gpu/device.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Cost of one technique for one class of lights. Times have the baseline subtracted: a technique of practically no
/// cost with the same loads, loops and stores.
struct GpuSamplerTiming {
    std::string technique; ///< class name; one that ends in Peters follows the published formulas
    std::string configuration;
    double light_ns = 0;  ///< per light that is prepared and sampled once, with clipping [ns], median
    double sample_ns = 0; ///< per sample, with 1/128 of preparing a light for 128 of them [ns], median
    /// Half the interquartile range of either time, with the baseline, over its median.
    double light_spread = 0, sample_spread = 0;
    /// Time over that of the published formulas, per light and per sample. None without published formulas, or if
    /// either time is not above the baseline.
    std::optional<double> light_ratio, sample_ratio;
};

struct GpuSamplerSettings {
    int repetitions = 15;                   ///< of the interleaved series; odd numbers give true medians
    std::optional<std::string> device = {}; ///< as gpu::DeviceOptions::choice
};

struct GpuSamplerTable {
    gpu::DeviceDescription device;
    gpu::Clock clock;
    bool fused_fma; ///< which variant of the shaders ran
    /// Threads of llvmpipe: the environment variable LP_NUM_THREADS, empty if it is not set. None for other devices.
    std::optional<std::string> llvmpipe_threads;
    std::vector<GpuSamplerTiming> rows;
};

/// What was measured of one technique and class of lights, or of the baseline.
struct GpuSamplerSeries {
    std::string technique; ///< "Baseline" before the techniques that it belongs to
    std::string configuration;
    std::vector<double> light_ns, sample_ns; ///< with the baseline
};

/// Medians less the baseline, spreads and ratios.
std::vector<GpuSamplerTiming> rows_of(const std::vector<GpuSamplerSeries>& series);

/// Times all techniques, interleaved, so that a drift of the clock rate hits all alike.
/// \throws gpu::NoDevice without a device.
GpuSamplerTable time_gpu_samplers(const GpuSamplerSettings& settings);

} // namespace nusselt::lab
