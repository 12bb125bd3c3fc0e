#pragma once
/// Cost of preparing and of sampling each technique, on one thread (Table 1 of both papers of Peters 2021).

#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Cost of one technique for one class of lights. All times are without the baseline, a technique of practically no
/// cost in the same loops over the same lights.
struct SamplerTiming {
    /// Class name; a name that ends in Peters is the plain transcription of the published formulas.
    std::string technique;
    std::string configuration; ///< for example "decentral, 4 vertices"
    std::string isa;           ///< instruction set the code was compiled for
    int lanes = 1; ///< 1 for scalar code, otherwise the lanes of a register or of two registers in flight
    double prepare_ns = 0;    ///< per light, with clipping [ns], median
    double sample_ns = 0;     ///< per sample, with different lights in the lanes [ns], median
    double sample_one_ns = 0; ///< per sample, with one light in all lanes [ns], median
    double spread = 0;        ///< half the interquartile range of prepare_ns over its median
    /// Times for preparing and for sampling, over those of the plain transcription in scalar code; 0 if there is
    /// none.
    double prepare_ratio = 0, sample_ratio = 0;
};

struct SamplerTimingSettings {
    int repetitions = 31;           ///< repetitions of the interleaved series; odd numbers give exact medians
    std::optional<std::string> isa; ///< as base::choose_isa()
};

/// Times all techniques in turn, so that a drift of the clock rate affects all alike.
/// \throws std::runtime_error for an instruction set that is unknown or that the CPU lacks.
std::vector<SamplerTiming> time_samplers(const SamplerTimingSettings& settings);

} // namespace nusselt::lab
