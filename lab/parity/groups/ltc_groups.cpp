#include "lab/parity/groups/ltc_groups.h"

namespace nusselt::parity {

void add_ltc_cases(std::vector<ParityCase>& cases) {
    const auto engine_words = [] { return words_of(engine_bytes()); };
    for (const ParityCase& group :
         {group_case<ShadingFrames>(), group_case<Lobes>(), group_case<PolygonShading>({.calls_divisor = 4}),
          group_case<LineShading>({.calls_divisor = 4}), group_case<Table>({.table = table_words}),
          group_case<EngineTable>({.table = engine_words})})
        cases.push_back(group);
}

} // namespace nusselt::parity
