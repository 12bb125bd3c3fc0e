#pragma once
/// Our renderer beside another one: errors and times of the same direct light. lab/peers/compare.py measures;
/// docs/peers.md says what makes the comparison fair.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::lab {

struct PeerComparison {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    std::string scene; ///< as lab/peers/compare.py names it, which also has the efficiency that is expected
    double mean_tolerance; ///< largest difference between the means of the converged images, relative
    int repetitions = 5;
    int reference_samples = 1024;
    int shrink = 1; ///< divides the width and height of images
};

const std::vector<PeerComparison>& all_peer_comparisons();

/// Small images, once, with coarse references.
PeerComparison quick(PeerComparison comparison);

/// What this machine lacks to run comparisons, and how to get it; empty if nothing.
std::string obstacle(const PeerComparison& comparison);

struct PeerComparisonResult {
    PeerComparison comparison;
    Results numbers; ///< as compare.py writes them
    std::vector<ReportImage> images;
    std::vector<std::filesystem::path> files; ///< on which the numbers depend
};

/// Renders with one thread each, whatever the settings say; references take all cores.
/// \throws std::runtime_error if the script is not beside the folder of scenes, or if a renderer fails
PeerComparisonResult run_peer_comparison(const PeerComparison& comparison, const RunSettings& settings,
                                         const ProgressText& progress);

/// The result from the file that compare.py writes, without images and files.
/// \throws std::runtime_error if the text has another format
PeerComparisonResult peer_comparison_of(const PeerComparison& comparison, const std::string& json);

/// \throws std::runtime_error if numbers are missing
Report report_of(const PeerComparisonResult& result);

} // namespace nusselt::lab
