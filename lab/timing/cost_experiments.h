#pragma once
/// Table 1 of C. Peters 2021, BRDF Importance Sampling for Polygonal Lights and for Linear Lights, on the processor.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"
#include "lab/timing/sampler_timing.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// A table of costs.
struct CostTable {
    std::string name; ///< on the command line
    std::string source;
    std::string description;             ///< one sentence
    std::vector<std::string> techniques; ///< class names, in the order of the paper
    std::vector<std::string> lights;     ///< SamplerTiming::configuration
    int repetitions = 61;
};

const std::vector<CostTable>& all_cost_tables();

/// A quarter of the repetitions.
CostTable quick(CostTable table);

struct CostTableResult {
    CostTable table;
    std::string isa;
    std::vector<SamplerTiming> rows; ///< of all techniques
};

/// \throws std::runtime_error see time_samplers()
CostTableResult run_cost_table(const CostTable& table, const RunSettings& settings,
                               const ProgressText& progress);

/// Costs of a light with a sample and of a sample alone, as scalars and packs, and the ratios that the papers state.
Report report_of(const CostTableResult& result);

} // namespace nusselt::lab
