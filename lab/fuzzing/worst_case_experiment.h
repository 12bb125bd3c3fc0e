#pragma once
/// Worst and typical errors of the iterations, ours and the published ones, and their order of convergence: C. Peters 2021,
/// BRDF Importance Sampling for Linear Lights, Sec. 3.4, and BRDF Importance Sampling for Polygonal Lights, Sec. 3.5 and 3.6.

#include "lab/fuzzing/convergence.h"
#include "lab/fuzzing/worst_case.h"
#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <string>
#include <vector>

namespace nusselt::lab {

struct WorstCaseStudy {
    std::string name; ///< on the command line
    std::string source;
    std::string description;      ///< one sentence
    std::uint64_t starts = 20000; ///< of each search
    int cases = 1'000'000;        ///< random ones, for quantiles
};

const std::vector<WorstCaseStudy>& all_worst_case_studies();

/// Few starts and cases.
WorstCaseStudy quick(WorstCaseStudy study);

/// Quantiles of the backward error over random cases.
struct TypicalErrors {
    std::string lights;
    double median, p99, largest;
};

struct WorstCaseStudyResult {
    WorstCaseStudy study;
    std::vector<WorstCaseSearch> searches;
    std::vector<TypicalErrors> typical;
    std::vector<ConvergenceRow> line_convergence, sector_convergence;
    /// Errors of both iterations in a sector where the published one diverges.
    long double divergent_published = 0, divergent_ours = 0;
};

WorstCaseStudyResult run_worst_case_study(const WorstCaseStudy& study, const RunSettings& settings,
                                          const ProgressText& progress);

Report report_of(const WorstCaseStudyResult& result);

} // namespace nusselt::lab
