#pragma once
/// Pictures of how techniques map random numbers to lights: C. Peters 2021, BRDF Importance Sampling for Polygonal Lights,
/// Fig. 8 and 13.

#include "lab/report/report.h"
#include "lab/report/run_settings.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// Pictures of draw_sampling_map().
struct MapSet {
    std::string name; ///< on the command line
    std::string source;
    std::string description;             ///< one sentence
    std::vector<std::string> techniques; ///< out of mapped_techniques()
};

const std::vector<MapSet>& all_map_sets();

/// Pictures take no time.
inline MapSet quick(MapSet set) { return set; }

struct MapSetResult {
    MapSet set;
    std::vector<std::string> pictures; ///< SVG, in the order of the techniques
};

MapSetResult run_map_set(const MapSet& set, const RunSettings& settings, const ProgressText& progress);

Report report_of(const MapSetResult& result);

} // namespace nusselt::lab
