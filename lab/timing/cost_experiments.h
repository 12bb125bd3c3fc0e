#pragma once
/// Table 1 of C. Peters 2021, BRDF Importance Sampling for Polygonal Lights and for Linear Lights, on the processor.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"
#include "lab/timing/sampler_timing.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// The columns of the tables in the papers.
enum class Cost {
    lights,  ///< "128 lights": a light that is prepared for one sample
    samples, ///< "128 samples": one of 128 samples of a light, with its share in preparing the light
};

/// A row of a table: a technique and the class of lights that it samples.
struct CostRow {
    std::string label; ///< as lab/report/published.json names it
    std::string technique;
    std::string lights; ///< LightClass::name
};

/// What the paper says about the cost of one technique over that of another.
struct CostRatio {
    std::string item;     ///< id of an item of lab/report/published.json
    std::string quantity; ///< as the item names it
    Cost cost;
    std::string row;   ///< a label
    std::string other; ///< likewise
};

/// Two rows whose ratio matters.
struct CostComparison {
    std::string row;   ///< a label
    std::string other; ///< likewise
};

/// A table of costs.
struct CostTable {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    std::string item;        ///< the table in lab/report/published.json
    std::vector<CostRow> rows;
    /// Of polygons, the numbers of vertices; 0 for lines. Techniques are compiled for each of them, as in the paper.
    std::vector<int> vertices;
    int usual_vertices; ///< for the ratios that the text states
    std::vector<CostComparison> comparisons;
    std::vector<CostRatio> ratios;
    int repetitions = 401;
};

const std::vector<CostTable>& all_cost_tables();

/// A few repetitions.
CostTable quick(CostTable table);

/// How techniques are compiled.
struct CostCode {
    std::string code; ///< SamplerTiming::code
    std::string isa;  ///< SamplerTiming::isa
};

/// Scalars and packs of one register for the processor; where it has AVX-512, those of AVX2 and packs of AVX-512.
std::vector<CostCode> cost_codes();

struct CostTableResult {
    CostTable table;
    std::vector<CostCode> codes; ///< scalars first
    std::vector<SamplerTiming> rows;
};

/// \throws std::runtime_error see time_samplers()
CostTableResult run_cost_table(const CostTable& table, const RunSettings& settings,
                               const ProgressText& progress);

/// Costs of a light with a sample and of a sample alone beside the published ones, as scalars and packs, the ratios
/// between techniques for each number of vertices, and those that the text states.
Report report_of(const CostTableResult& result);

} // namespace nusselt::lab
