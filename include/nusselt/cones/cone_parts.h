#pragma once
/// What samplers of cones share: densities at the nodes of a rim, and measures that have an inverse.

#include <limits>
#include <type_traits>

#include <nusselt/core/broadcast.h>
#if NUSSELT_HAS_VERTEX_LANES
#include <nusselt/simd/pack.h>
#endif

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// Fills the nodes of a RimDistribution. Scalar code takes the nodes as lanes, which have the bits of scalars.
/// \tparam Density Density::density_at(map, node) is the density at a node.
template <class Density, template <class> class Map, class Real>
struct DensitiesAtNodes {
    const Map<Real>& map;

    template <class Nodes>
    NUSSELT_HD void operator()(Real (&value)[Nodes::kNodes]) const noexcept {
#if NUSSELT_HAS_VERTEX_LANES
        if constexpr (std::is_same_v<Real, float>) {
            constexpr int kLanes = 8;
            using Lanes = Pack<float, kLanes>;
            const Map<Lanes> lanes(map);
            float node[Nodes::kNodes];
            for (int i = 0; i < Nodes::kNodes; ++i) node[i] = Nodes::node(i);
            for (int i = 0; i < Nodes::kNodes; i += kLanes)
                Density::density_at(lanes, Lanes::load(node + i)).store(value + i);
            return;
        }
#endif
        for (int i = 0; i < Nodes::kNodes; ++i) value[i] = Density::density_at(map, Real(Nodes::node(i)));
    }
};

/// \tparam Density see DensitiesAtNodes.
template <class Density, template <class> class Map, class Real>
NUSSELT_INLINE DensitiesAtNodes<Density, Map, Real> densities_at_nodes(const Map<Real>& map) noexcept {
    return {map};
}

} // namespace detail

/// A measure and its inverse; both are 0 without light.
template <class Real>
struct ConeMeasure {
    Real value, inverse;
};

template <class Real, class Single>
NUSSELT_INLINE ConeMeasure<Real> broadcast(const ConeMeasure<Single>& measure) noexcept {
    return {Real(measure.value), Real(measure.inverse)};
}

template <class Real>
NUSSELT_INLINE ConeMeasure<Real> cone_measure(const Real& measure, const mask_t<Real>& is_lit) noexcept {
    const Real inverse = Real(1) / select(measure > Real(0), measure, Real(1));
    // Fractions of the measure must not be denormal: processors may flush them to zero.
    const auto positive = measure > Real(4 * std::numeric_limits<scalar_t<Real>>::min());
    const auto lit = is_lit & positive & is_finite(inverse);
    return {select(lit, measure, Real(0)), select(lit, inverse, Real(0))};
}

NUSSELT_NAMESPACE_END
