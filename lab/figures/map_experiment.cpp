#include "lab/figures/map_experiment.h"

#include "lab/figures/sampling_map.h"

namespace nusselt::lab {

const std::vector<MapSet>& all_map_sets() {
    static const std::vector<MapSet> sets = {
        {"maps",
         "Peters 2021, polygonal lights, Fig. 8 and 13",
         "A grid of 12 x 12 random numbers and blue noise, mapped to three lights, and equal steps, mapped "
         "to lines.",
         {"PolygonProjectedSolidAngle", "PolygonSolidAngle", "PolygonProjectedSolidAngleArvo",
          "PolygonSolidAngleArvo", "PolygonProjectedSolidAngleBiased", "PolygonArea",
          "LineProjectedSolidAngle", "LineSolidAngle", "LineArea"}}};
    return sets;
}

MapSetResult run_map_set(const MapSet& set, const RunSettings& /*nothing is rendered*/,
                         const ProgressText& progress) {
    MapSetResult result = {set, {}};
    for (const std::string& technique : set.techniques) {
        progress(technique);
        result.pictures.push_back(draw_sampling_map(technique));
    }
    return result;
}

Report report_of(const MapSetResult& result) {
    Report report;
    for (std::size_t i = 0; i < result.pictures.size(); ++i) {
        const std::string& technique = result.set.techniques[i];
        report.drawings.push_back({technique, technique, result.pictures[i]});
    }
    report.numbers = {result.set.name, {}, {}};
    return report;
}

} // namespace nusselt::lab
