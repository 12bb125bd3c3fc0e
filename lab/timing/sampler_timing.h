#pragma once
/// Cost of preparing and of sampling each technique, on one thread (Table 1 of both papers of Peters 2021).

#include "lab/timing/sampler_timing_kernel.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Cost of one technique for one class of lights. All costs are without the baseline, a technique of practically no
/// cost in the same loops over the same lights.
struct SamplerTiming {
    std::string technique;     ///< class name; a name that ends in Peters has the published formulas
    std::string configuration; ///< for example "decentral, 4 vertices"
    /// How the technique is compiled: "scalar", packs of the lanes of one register or of two in flight, or a compiler with
    /// options. Only costs of the same code compare.
    std::string code;
    std::string isa; ///< instruction set the code was compiled for
    /// Per light, and per sample of many of a prepared light [ns], medians.
    std::optional<double> prepare_ns, sample_ns;
    std::optional<double> once_ns; ///< prepare and take one sample, in one go
    /// Half of the interquartile range of these times [ns].
    std::optional<double> prepare_spread_ns, sample_spread_ns, once_spread_ns;
    std::optional<double> direction_ns; ///< a sample without density and hit point
    std::optional<double> transform_ns; ///< to shading space
    std::optional<double> world_ns;     ///< transform and prepare together
    std::optional<double> prepare_instructions, sample_instructions; ///< executed
    /// Costs over those of the published formulas in the same code.
    std::optional<double> prepare_ratio, sample_ratio, world_ratio, once_ratio;
    std::optional<double> prepare_instructions_ratio, sample_instructions_ratio;
    /// For polygons, ratio over that of lights of the same class with 4 vertices: above 1, the technique grows faster with
    /// the number of vertices than the published formulas.
    std::optional<double> prepare_growth, sample_growth;
};

/// The techniques that are timed in an instruction set, which must be supported: polygons have four vertices, with AVX2 also
/// 3, 5, 6 and 7.
std::vector<TimedTechnique> timed_techniques_for(base::Isa isa);

/// The code of the rows of packs with this many lanes, or of scalars.
std::string name_of_code(int lanes);

struct SamplerTimingSettings {
    int repetitions = 31;           ///< repetitions of the interleaved series; odd numbers give exact medians
    std::optional<std::string> isa; ///< as base::choose_isa()
    std::vector<std::string> techniques = {};     ///< class names; empty: all
    std::vector<std::string> configurations = {}; ///< as SamplerTiming::configuration; empty: all
};

/// Times all techniques as scalars and packs in turn, so that a drift of the clock rate affects all alike. Without ratios.
/// \throws std::runtime_error for an instruction set that is unknown or that the CPU lacks.
std::vector<SamplerTiming> time_samplers(const SamplerTimingSettings& settings);

/// Fills the ratios and growths of all rows.
void add_ratios(std::vector<SamplerTiming>& rows);

} // namespace nusselt::lab
