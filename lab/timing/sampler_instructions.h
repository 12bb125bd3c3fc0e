#pragma once
/// How many instructions techniques execute. Unlike times, these numbers are the same in each run on each machine, so that
/// a test can tell whether the cost of a sampler has moved.

#include "lab/results/results.h"
#include "lab/timing/sampler_timing_kernel.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Of one technique, means over some lights of a class, without those of the baseline. Those of packs count once for all
/// lanes.
struct SamplerInstructions {
    std::string technique;     ///< class name
    std::string configuration; ///< as SamplerTiming::configuration
    std::string code;          ///< as SamplerTiming::code
    double prepare = 0;        ///< per light
    double sample = 0;         ///< per sample, with density and hit point
};

struct SamplerInstructionTable {
    std::string isa;      ///< instruction set the code was compiled for
    std::string compiler; ///< of this program, such as "g++ 12"
    std::vector<SamplerInstructions> rows;
};

/// Counts the instructions of the given techniques for decentral quadrilaterals, for those that cross the horizon, and for
/// the corresponding lines and cylinders.
/// \param techniques with their baselines before them, as timed_techniques_for() returns them.
/// \returns no rows on machines that cannot count
SamplerInstructionTable count_sampler_instructions(base::Isa isa,
                                                   const std::vector<TimedTechnique>& techniques);

/// \throws std::runtime_error if the file has another format
SamplerInstructionTable read_sampler_instructions(const std::filesystem::path& json);

Results results_of(const SamplerInstructionTable& table);

/// The rows that differ by more than the tolerance in either direction, and those that one table lacks, in words.
/// \param tolerance relative; differences of few instructions do not count.
std::vector<std::string> moved_costs(const SamplerInstructionTable& before,
                                     const SamplerInstructionTable& now, double tolerance);

} // namespace nusselt::lab
