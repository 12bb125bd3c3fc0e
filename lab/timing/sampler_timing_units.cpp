/// Compiled once per instruction set; see sampler_timing_kernel.h.

#include "lab/timing/sampler_timing_impl.h"

NUSSELT_NAMESPACE_BEGIN
namespace timing {

/// All techniques, polygons having four vertices. Those with published formulas also with two registers in flight.
constexpr Rows all_rows() {
    using namespace hostile;
    // A baseline belongs to the type of light that techniques take, so rectangles share that of polygons.
    using Quadrilaterals = Join<Polygons, TestedBy<TimingSuite, RectangleKinds>>;
    using Lines = TestedBy<TimingSuite, LineKinds>;
    Rows rows;
    const auto add_kinds = [&]<class Real> {
        add_all<Real>(Quadrilaterals(), rows);
        add_all<Real>(Lines(), rows);
        add_all<Real>(TestedBy<TimingSuite, PolygonOnLobeKinds<4>>(), rows);
        add_all<Real>(TestedBy<TimingSuite, LineOnLobeKinds>(), rows);
        add_all<Real>(TestedBy<TimingSuite, CylinderKinds>(), rows);
        add_all<Real>(TestedBy<TimingSuite, CylinderOnLobeKinds>(), rows);
        // The baseline belongs to the first shape, the others cost it the same.
        add_all<Real>(TestedBy<TimingSuite, RoundKinds>(), rows);
        add_all<Real>(TestedBy<TimingSuite, RoundOnLobeKinds>(), rows);
    };
    add_kinds.template operator()<float>();
    add_kinds.template operator()<Native>();
    add_compared<Pair>(Polygons(), rows);
    add_compared<Pair>(Lines(), rows);
    return rows;
}

inline constexpr Rows kRows = all_rows();

} // namespace timing
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
TimedTechniques timed_techniques<base::Isa::NUSSELT_UNIT_ISA>() {
    return {timing::kRows.row, timing::kRows.count};
}

} // namespace nusselt::lab
