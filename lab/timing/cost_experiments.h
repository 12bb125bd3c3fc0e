#pragma once
/// Table 1 of C. Peters 2021, BRDF Importance Sampling for Polygonal Lights and for Linear Lights, on the processor.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"
#include "lab/timing/sampler_timing.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// What the columns "128 samples" and "128 lights" of the papers measure.
enum class Cost {
    sample, ///< one more sample of a prepared light
    light,  ///< a light that is prepared for one sample
};

/// A ratio that a paper states: the cost of one technique over that of another.
struct CostRatio {
    std::string item;     ///< id of an item of lab/report/published.json
    std::string quantity; ///< as the item names it
    double published;
    Cost cost;
    std::string technique;
    std::string other;
    std::string lights;
};

/// A table of costs.
struct CostTable {
    std::string name; ///< on the command line
    std::string source;
    std::string description;             ///< one sentence
    std::vector<std::string> techniques; ///< class names, in the order of the paper
    std::vector<std::string> lights;     ///< SamplerTiming::configuration
    std::vector<CostRatio> ratios;
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
