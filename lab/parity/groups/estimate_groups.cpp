#include "lab/parity/groups/estimate_groups.h"

namespace nusselt::parity {

void add_estimate_cases(std::vector<ParityCase>& cases) {
    // Samples may fall on either side of an edge. Estimates look up a lobe for each surface, which takes long.
    const GroupSettings samples{.tail = Tail::nearly_largest};
    const GroupSettings pairs{.calls_divisor = 2, .tail = Tail::nearly_largest};
    const GroupSettings estimates{.calls_divisor = 8, .table = table_words, .tail = Tail::nearly_largest};
    for (const ParityCase& group :
         {group_case<Heuristics>(), group_case<VisibleNormals>(samples),
          group_case<PolygonBrdfSampling>(pairs), group_case<PolygonDirectLight>(estimates),
          group_case<LineDirectLight>(estimates), group_case<BrdfDirectLight>(estimates)})
        cases.push_back(group);
}

} // namespace nusselt::parity
