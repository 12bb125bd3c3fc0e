#pragma once
/// Sorting networks for the azimuths of the vertices of a convex polygon. All indices are static, as SIMD and GPUs want
/// (Peters 2021, polygonal lights, Sec. 3.7 and supplement A.6).
///
/// In vertex order these azimuths are a cyclic rotation of a sequence that rises and then falls, and networks for such
/// sequences need up to a third fewer comparators. These are for any order, with the fewest comparators
/// (Knuth, The Art of Computer Programming, vol. 3, Sec. 5.3.4; nine elements: Codish et al. 2014): rounding of a thin
/// light may break the cyclic order.

#include <utility>

#include <nusselt/core/config.h>

NUSSELT_NAMESPACE_BEGIN

struct Comparator {
    int low, high; ///< the smaller element ends up in slot `low`
};

template <int M>
struct SortingNetwork;
template <>
struct SortingNetwork<3> {
    static constexpr Comparator kComparators[] = {{1, 2}, {0, 1}, {1, 2}};
};
template <>
struct SortingNetwork<4> {
    static constexpr Comparator kComparators[] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}, {1, 2}};
};
template <>
struct SortingNetwork<5> {
    static constexpr Comparator kComparators[] = {{0, 3}, {1, 4}, {0, 2}, {1, 3}, {0, 1},
                                                  {2, 4}, {1, 2}, {3, 4}, {2, 3}};
};
template <>
struct SortingNetwork<6> {
    static constexpr Comparator kComparators[] = {{0, 5}, {1, 3}, {2, 4}, {1, 2}, {3, 4}, {0, 3},
                                                  {2, 5}, {0, 1}, {2, 3}, {4, 5}, {1, 2}, {3, 4}};
};
template <>
struct SortingNetwork<7> {
    static constexpr Comparator kComparators[] = {{0, 6}, {2, 3}, {4, 5}, {0, 2}, {1, 4}, {3, 6},
                                                  {0, 1}, {2, 5}, {3, 4}, {1, 2}, {4, 6}, {2, 3},
                                                  {4, 5}, {1, 2}, {3, 4}, {5, 6}};
};
template <>
struct SortingNetwork<8> {
    static constexpr Comparator kComparators[] = {{0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6},
                                                  {3, 7}, {0, 1}, {2, 3}, {4, 5}, {6, 7}, {2, 4}, {3, 5},
                                                  {1, 4}, {3, 6}, {1, 2}, {3, 4}, {5, 6}};
};
template <>
struct SortingNetwork<9> {
    static constexpr Comparator kComparators[] = {{0, 3}, {1, 7}, {2, 5}, {4, 8}, {0, 7}, {2, 4}, {3, 8},
                                                  {5, 6}, {0, 2}, {1, 3}, {4, 5}, {7, 8}, {1, 4}, {3, 6},
                                                  {5, 7}, {0, 1}, {2, 4}, {3, 5}, {6, 8}, {2, 3}, {4, 5},
                                                  {6, 7}, {1, 2}, {3, 4}, {5, 6}};
};

namespace detail {

/// Slots become constants: device code has no addresses of constant arrays, and packs stay in registers.
template <class Network, class CompareAndSwap, int... I>
NUSSELT_HD inline void for_each_comparator(CompareAndSwap& compare_and_swap,
                                           std::integer_sequence<int, I...>) noexcept {
    (compare_and_swap(std::integral_constant<int, Network::kComparators[I].low>::value,
                      std::integral_constant<int, Network::kComparators[I].high>::value),
     ...);
}

} // namespace detail

/// Sorts M elements.
/// \param compare_and_swap called with the two slots (low, high) of each comparator in turn.
template <int M, class CompareAndSwap>
NUSSELT_HD inline void sort_by_network(CompareAndSwap compare_and_swap) noexcept {
    using Network = SortingNetwork<M>;
    constexpr int kCount = sizeof(Network::kComparators) / sizeof(Comparator);
    detail::for_each_comparator<Network>(compare_and_swap, std::make_integer_sequence<int, kCount>());
}

NUSSELT_NAMESPACE_END
