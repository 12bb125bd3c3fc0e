#pragma once
/// The cost of the visibility of line samples, and the number of parts into which occluders cut them: N. Billen and P.
/// Dutre 2016, Line Sampling for Direct Illumination, Figure 5 and Table 1.

#include "image/planes.h"
#include "lab/lines/line_by_line.h"
#include "lab/lines/line_scenes.h"
#include "lab/report/report.h"
#include "render_cpu/renderer.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Work for one line, the mean over an image.
struct WorkPerLine {
    double parts = 0;     ///< visible ones
    double box_tests = 0; ///< of boxes of the hierarchy
    double triangle_tests = 0;
};

/// Expects lines to be more work in one scene than in another.
struct MoreWork {
    double WorkPerLine::*work;
    std::string scene;
    std::string than;
};

struct LineVisibility {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    std::vector<LineScene> scenes;
    std::vector<MoreWork> expectations;
    int lines; ///< per shading point and light
    int width; ///< of the images in pixels
    int step;  ///< lines are traced one by one in every pixel of so many, in both directions
    std::string
        table_item; ///< id of the published item with the numbers of Table 1; empty if it is another one
};

const std::vector<LineVisibility>& all_line_visibilities();

/// Small images and few lines.
LineVisibility quick(LineVisibility experiment);

struct LineVisibilityScene {
    std::string scene;
    bool is_skipped = false;                  ///< it is not there
    std::vector<std::filesystem::path> files; ///< it was read from
    image::Image image;
    image::Plane parts; ///< visible ones of each line, means over pixels
    render::RenderStatistics statistics;
    WorkPerLine work;
    LineByLineWork one_by_one; ///< in some of the pixels
    WorkPerLine work_one_by_one;
    double parts_together = 0; ///< visible parts per line in the same pixels, by the renderer
};

struct LineVisibilityResult {
    const LineVisibility* experiment = nullptr;
    int width = 0;
    std::vector<LineVisibilityScene> scenes;
    std::vector<ExpectationResult> expectations;
};

/// \throws std::runtime_error if a scene cannot be loaded
LineVisibilityResult run_line_visibility(const LineVisibility& experiment, const RunSettings& settings,
                                         const ProgressText& progress);

/// The outcomes of the expectations. Those about scenes that were skipped are not evaluated.
std::vector<ExpectationResult> check_expectations(const LineVisibility& experiment,
                                                  const std::vector<LineVisibilityScene>& scenes);

/// The tables, the images, and the parts in false colours.
Report report_of(const LineVisibilityResult& result);

} // namespace nusselt::lab
