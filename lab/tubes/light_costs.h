#pragma once
/// The cost of analytic shading, on the processor: E. Heitz, S. Hill 2017, Linear-Light Shading with Linearly Transformed
/// Cosines, Sec. 1.5.4 and 1.7.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::lab {

/// Lights above a floor of metal, all of them at all pixels.
struct LightCosts {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    int lights = 64;
    int width = 192; ///< of the images in pixels
    int repetitions = 31;
};

const std::vector<LightCosts>& all_light_costs();

/// A quarter of the repetitions.
LightCosts quick(LightCosts costs);

/// A kind of light.
struct LightCost {
    std::string light;
    double ns;     ///< of one light at one shading point, the median over the repetitions
    double spread; ///< half the interquartile range [ns]
    double ratio;  ///< of the time to that of the last kind, the median over the repetitions
};

struct LightCostsResult {
    LightCosts costs;
    std::vector<LightCost> lights;
    std::vector<std::filesystem::path> files;
};

/// \throws std::runtime_error if the scene cannot be loaded
LightCostsResult run_light_costs(const LightCosts& costs, const RunSettings& settings,
                                 const ProgressText& progress);

Report report_of(const LightCostsResult& result);

} // namespace nusselt::lab
