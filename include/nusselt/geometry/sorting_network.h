#pragma once
/// Sorting networks for the azimuths of the vertices of a convex polygon.
///
/// In vertex order these azimuths are a cyclic rotation of a sequence that rises and then falls. Networks for
/// such bitonic sequences need fewer comparators than general ones, and a network keeps all indices static,
/// as SIMD and GPUs want (Peters 2021, polygonal lights, Sec. 3.7 and supplement A.6). The networks for 3 to
/// 7 elements were found by exhaustive search, that for 8 meets a lower bound; that for 9 is the result of a
/// beam search and may not be minimal. tests/unit/geometry/sorting_network_test.cpp checks all of them.

#include <utility>

#include <nusselt/core/config.h>

NUSSELT_NAMESPACE_BEGIN

struct Comparator {
    int low, high; ///< the smaller element ends up in slot `low`
};

template <int M>
struct BitonicNetwork;
template <>
struct BitonicNetwork<3> {
    static constexpr Comparator kComparators[] = {{1, 2}, {0, 1}, {1, 2}};
};
template <>
struct BitonicNetwork<4> {
    static constexpr Comparator kComparators[] = {{1, 3}, {0, 2}, {0, 1}, {2, 3}};
};
template <>
struct BitonicNetwork<5> {
    static constexpr Comparator kComparators[] = {{0, 3}, {2, 4}, {3, 4}, {0, 2},
                                                  {0, 1}, {1, 4}, {1, 3}, {1, 2}};
};
template <>
struct BitonicNetwork<6> {
    static constexpr Comparator kComparators[] = {{3, 5}, {0, 2}, {1, 3}, {2, 4}, {0, 2},
                                                  {3, 5}, {0, 1}, {2, 3}, {4, 5}};
};
template <>
struct BitonicNetwork<7> {
    static constexpr Comparator kComparators[] = {{2, 6}, {3, 5}, {0, 1}, {0, 3}, {1, 4}, {5, 6},
                                                  {1, 2}, {3, 5}, {4, 6}, {2, 3}, {4, 5}, {0, 1}};
};
template <>
struct BitonicNetwork<8> {
    static constexpr Comparator kComparators[] = {{1, 5}, {2, 6}, {0, 4}, {3, 7}, {0, 2}, {4, 6},
                                                  {5, 7}, {1, 3}, {6, 7}, {4, 5}, {2, 3}, {0, 1}};
};
template <>
struct BitonicNetwork<9> {
    static constexpr Comparator kComparators[] = {{5, 8}, {4, 7}, {0, 3}, {2, 5}, {3, 6}, {1, 4},
                                                  {5, 8}, {0, 3}, {4, 7}, {7, 8}, {0, 1}, {3, 4},
                                                  {0, 2}, {6, 7}, {7, 8}, {4, 5}, {3, 4}, {1, 2}};
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

/// Sorts the M elements of a bitonic sequence.
/// \param compare_and_swap called with the two slots (low, high) of each comparator in turn.
template <int M, class CompareAndSwap>
NUSSELT_HD inline void sort_bitonic(CompareAndSwap compare_and_swap) noexcept {
    using Network = BitonicNetwork<M>;
    constexpr int kCount = sizeof(Network::kComparators) / sizeof(Comparator);
    detail::for_each_comparator<Network>(compare_and_swap, std::make_integer_sequence<int, kCount>());
}

NUSSELT_NAMESPACE_END
