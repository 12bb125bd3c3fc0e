#pragma once
/// Cost of each technique in GLSL on a GPU (Table 1 of both papers of Peters 2021).

#include "gpu/device.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Cost of one technique for one class of lights. All times are without the baseline, a technique of practically no
/// cost with the same loads, loops and stores.
struct GpuSamplerTiming {
    std::string technique; ///< class name; one that ends in Peters follows the published formulas
    std::string configuration;
    double light_ns = 0;     ///< per light that is prepared, clipped and sampled once [ns], median
    double sample_ns = 0;    ///< per sample, with 1/128 of preparing its light [ns], median
    bool directions = false; ///< the samples are directions without density and hit point
    /// Half the interquartile range of either time over its median, including the baseline.
    double light_spread = 0, sample_spread = 0;
    /// Time over that of the published formulas, per light and per sample. None without published formulas, or if
    /// either time is not above the baseline.
    std::optional<double> light_ratio, sample_ratio;
};

struct GpuSamplerSettings {
    int repetitions = 15; ///< repetitions of the interleaved series; odd numbers give exact medians
    std::optional<std::string> device = {}; ///< as gpu::DeviceOptions::choice
};

struct GpuSamplerTable {
    gpu::DeviceDescription device;
    gpu::Clock clock;
    bool fused_fma; ///< see gpu::has_fused_fma()
    /// The number of llvmpipe's threads from the environment variable LP_NUM_THREADS, empty if it is not set. None
    /// for other devices.
    std::optional<std::string> llvmpipe_threads;
    std::vector<GpuSamplerTiming> rows;
};

/// The measurements of one technique, or of the baseline, for one class of lights.
struct GpuSamplerSeries {
    std::string technique; ///< class name, or "Baseline", which precedes its techniques
    std::string configuration;
    std::vector<double> light_ns, sample_ns; ///< including the baseline
    bool directions = false;                 ///< as GpuSamplerTiming::directions
};

/// Computes the medians minus the baseline, the spreads and the ratios.
std::vector<GpuSamplerTiming> rows_of(const std::vector<GpuSamplerSeries>& series);

/// Times all techniques in turn, so that a drift of the clock rate affects all alike.
/// \throws gpu::NoDevice without a device.
GpuSamplerTable time_gpu_samplers(const GpuSamplerSettings& settings);

} // namespace nusselt::lab
