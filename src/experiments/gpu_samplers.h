#pragma once
/// Cost of each technique in GLSL on a GPU (Table 1 of both papers of Peters 2021).

#include "gpu/device.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::experiments {

/// Cost of one technique for one class of lights. Times have the baseline subtracted: a technique of practically no
/// cost with the same loads, loops and stores.
struct GpuSamplerTiming {
    std::string technique; ///< class name; one that ends in Peters follows the published formulas
    std::string configuration;
    double light_ns = 0;  ///< per light that is prepared and sampled once, with clipping [ns], median
    double sample_ns = 0; ///< per sample, with 1/128 of preparing a light for 128 of them [ns], median
    double spread = 0;    ///< half the interquartile range of light_ns, with the baseline, over its median
    /// Time over that of the published formulas, per light and per sample; 0 if there are none.
    double light_ratio = 0, sample_ratio = 0;
};

struct GpuSamplerSettings {
    int repetitions = 15;                   ///< of the interleaved series; odd numbers give true medians
    std::optional<std::string> device = {}; ///< as gpu::DeviceOptions::choice
};

struct GpuSamplerTable {
    gpu::DeviceDescription device;
    gpu::Clock clock;
    bool fused_fma; ///< which variant of the shaders ran
    /// Threads of a software device: the environment variable LP_NUM_THREADS, empty if it is not set.
    std::string software_threads;
    std::vector<GpuSamplerTiming> rows;
};

/// Times all techniques, interleaved, so that a drift of the clock rate hits all alike.
/// \throws gpu::NoDevice without a device.
GpuSamplerTable time_gpu_samplers(const GpuSamplerSettings& settings);

} // namespace nusselt::experiments
