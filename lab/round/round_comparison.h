#pragma once
/// Noise and cost of sampling diffuse light from spheres and disks: our techniques next to published ones, at equal samples and at
/// equal time.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"
#include "lab/round/round_kernels.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// Where the lights of a class are.
enum class RoundPlace { above, cut, close, small };

struct RoundComparison {
    std::string name; ///< on the command line
    std::string source;
    std::string description;
    RoundTechniques (*techniques)();
    void (*make_lights)(RoundPlace place, RoundLights& lights);
    int repetitions = 41; ///< of the interleaved series
};

const std::vector<RoundComparison>& all_round_comparisons();

/// A quarter of the repetitions.
RoundComparison quick(RoundComparison comparison);

/// Says so where the processor lacks AVX2, for which the techniques are compiled.
std::string obstacle(const RoundComparison& comparison);

/// One technique for lights of one class.
struct RoundRow {
    std::string technique;
    RoundOrigin origin;
    double
        noise; ///< of the cosine over the density of a sample, relative to its mean; root mean square over lights
    double invalid;    ///< share of samples without a weight
    double prepare_ns; ///< median
    double sample_ns;  ///< median
    double cost; ///< of preparing and one sample, relative to ours; median of the ratios within a repetition
};

struct RoundClass {
    std::string lights;
    bool is_exact; ///< whether our technique is to have constant weights
    std::vector<RoundRow> rows;
};

struct RoundResult {
    RoundComparison comparison;
    std::vector<RoundClass> classes;
};

RoundResult run_round_comparison(const RoundComparison& comparison, const RunSettings& settings,
                                 const ProgressText& progress);

Report report_of(const RoundResult& result);

} // namespace nusselt::lab
