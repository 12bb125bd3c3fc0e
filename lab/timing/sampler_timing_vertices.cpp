/// Polygons with other numbers of vertices than four, as scalars and packs of AVX2: compiling them for each instruction set
/// would take minutes, and another one changes these costs as it changes those of quadrilaterals.

#include "lab/timing/sampler_timing_impl.h"

NUSSELT_NAMESPACE_BEGIN
namespace timing {

template <int N, template <int> class... KindOf>
constexpr hostile::KindList<KindOf<N>...> with_bound(hostile::KindList<KindOf<4>...>) {
    return {};
}

constexpr Rows all_rows_with_other_bounds() {
    Rows rows;
    const auto add_bound = [&]<int N> {
        add_all<float>(with_bound<N>(Polygons()), rows);
        add_all<Native>(with_bound<N>(Polygons()), rows);
    };
    add_bound.template operator()<3>();
    add_bound.template operator()<5>();
    add_bound.template operator()<6>();
    add_bound.template operator()<7>();
    return rows;
}

inline constexpr Rows kRowsWithOtherBounds = all_rows_with_other_bounds();

} // namespace timing
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

TimedTechniques timed_techniques_with_other_bounds() {
    return {timing::kRowsWithOtherBounds.row, timing::kRowsWithOtherBounds.count};
}

} // namespace nusselt::lab
