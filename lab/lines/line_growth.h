#pragma once
/// How the work for the visibility of lines grows with the scene: N. Billen and P. Dutre 2016, Line Sampling for Direct
/// Illumination, Sec. 5.2, O(log n + m) for n triangles of which m overlap the triangle that a line spans with its point. Here
/// m grows with the number of triangles between floor and light.

#include "lab/lines/line_by_line.h"
#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// A number of triangles around the space between floor and light, and one of triangles in it.
struct GrowthSize {
    int around;    ///< n
    int occluders; ///< m
};

struct LineGrowth {
    std::string name; ///< on the command line
    std::string source;
    std::string description;    ///< one sentence
    std::vector<int> around;    ///< growing, with the smallest number of occluders
    std::vector<int> occluders; ///< growing, with the smallest number of triangles around
    int lines;                  ///< per shading point
    int width;                  ///< of the image in pixels
};

const std::vector<LineGrowth>& all_line_growths();

/// Smaller scenes.
LineGrowth quick(LineGrowth experiment);

/// Work for one line, the mean over all.
struct GrowthRow {
    GrowthSize size;
    double box_tests = 0, triangle_tests = 0, seconds = 0; ///< one by one
    double box_tests_together = 0, triangle_tests_together = 0, seconds_together = 0;
};

struct LineGrowthResult {
    const LineGrowth* experiment = nullptr;
    std::vector<GrowthRow> by_around, by_occluders;
    std::vector<ExpectationResult> expectations;
};

LineGrowthResult run_line_growth(const LineGrowth& experiment, const RunSettings& settings,
                                 const ProgressText& progress);

/// The outcomes of the expectations about these rows.
std::vector<ExpectationResult> check_expectations(const std::vector<GrowthRow>& by_around,
                                                  const std::vector<GrowthRow>& by_occluders);

Report report_of(const LineGrowthResult& result);

} // namespace nusselt::lab
