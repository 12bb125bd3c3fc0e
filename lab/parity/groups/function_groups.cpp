#include "lab/parity/groups/function_groups.h"

#include "lab/parity/groups/visible_part_group.h"

namespace nusselt::parity {

void add_function_cases(std::vector<ParityCase>& cases) {
    for (const ParityCase& group :
         {group_case<Arithmetic>(), group_case<Trigonometry>(), group_case<Frames>(), group_case<Brdfs>(),
          group_case<PhongLobes>(), group_case<Polygons>(), group_case<Clipping>(), group_case<Lines>(),
          group_case<VisibleParts>()})
        cases.push_back(group);
}

} // namespace nusselt::parity
