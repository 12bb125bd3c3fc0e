#pragma once
/// Lights in long double, cut to the parts that techniques can reach.

#include "ltc/reference.h"
#include "techniques.h"

namespace nusselt_test {

template <class T, int N>
Polygon whole(const nusselt::ConvexPolygon<T, N>& light) {
    return vertices_of(light);
}
template <class T>
Segment whole(const nusselt::LineSegment<T>& light) {
    return {widened_begin(light), widened_end(light)};
}

/// The part of a light that a technique can reach.
template <class Kind, class Light>
auto lit_part(const Light& light) {
    auto part = whole(light);
    if (Kind::kHorizon == Horizon::clipped) part = cut(part, {0, 0, 1});
    if constexpr (kHasLobe<Kind>) part = cut(part, ReferenceLobe(light.lobe).horizon());
    return part;
}

} // namespace nusselt_test
