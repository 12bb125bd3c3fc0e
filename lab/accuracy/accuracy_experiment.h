#pragma once
/// The accuracy tables in short, ours beside published methods, whose failures are part of what is checked.

#include "lab/accuracy/accuracy.h"
#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <string>
#include <vector>

namespace nusselt::lab {

struct AccuracyStudy {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    int count = 5000;        ///< lights per class
};

const std::vector<AccuracyStudy>& all_accuracy_studies();

/// A tenth of the lights.
AccuracyStudy quick(AccuracyStudy study);

struct AccuracyStudyResult {
    AccuracyStudy study;
    AccuracyTable table;
};

AccuracyStudyResult run_accuracy_study(const AccuracyStudy& study, const RunSettings& settings,
                                       const ProgressText& progress);

Report report_of(const AccuracyStudyResult& result);

} // namespace nusselt::lab
