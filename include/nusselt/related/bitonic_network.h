#pragma once
/// Sorting networks for cyclic rotations of sequences that rise and then fall, such as the azimuths of the vertices of
/// a convex polygon (Peters 2021, polygonal lights, supplement A.6). Found by a search over networks that sort all such
/// sequences of zeros and ones; the techniques use geometry/sorting_network.h, which sorts any order.

#include <nusselt/geometry/sorting_network.h>

NUSSELT_NAMESPACE_BEGIN

template <int M>
struct BitonicNetwork;
template <>
struct BitonicNetwork<3> {
    static constexpr Comparator kComparators[] = {{0, 1}, {0, 2}, {1, 2}};
};
template <>
struct BitonicNetwork<4> {
    static constexpr Comparator kComparators[] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};
};
template <>
struct BitonicNetwork<5> {
    static constexpr Comparator kComparators[] = {{0, 1}, {0, 2}, {0, 3}, {0, 4},
                                                  {1, 3}, {2, 4}, {1, 2}, {3, 4}};
};
template <>
struct BitonicNetwork<6> {
    static constexpr Comparator kComparators[] = {{0, 2}, {0, 4}, {1, 3}, {1, 5}, {2, 4},
                                                  {3, 5}, {0, 1}, {2, 3}, {4, 5}};
};
template <>
struct BitonicNetwork<7> {
    static constexpr Comparator kComparators[] = {{0, 1}, {0, 4}, {2, 6}, {3, 5}, {1, 5}, {2, 3},
                                                  {4, 6}, {1, 3}, {0, 2}, {1, 2}, {3, 4}, {5, 6}};
};
template <>
struct BitonicNetwork<8> {
    static constexpr Comparator kComparators[] = {{0, 4}, {1, 5}, {2, 6}, {3, 7}, {0, 2}, {4, 6},
                                                  {1, 3}, {5, 7}, {0, 1}, {2, 3}, {4, 5}, {6, 7}};
};
template <>
struct BitonicNetwork<9> {
    static constexpr Comparator kComparators[] = {{0, 3}, {0, 6}, {1, 4}, {5, 8}, {1, 7}, {2, 8},
                                                  {3, 6}, {2, 5}, {4, 7}, {0, 1}, {3, 4}, {6, 7},
                                                  {0, 2}, {1, 2}, {3, 5}, {4, 5}, {6, 8}, {7, 8}};
};

/// Sorts M elements in such an order.
/// \param compare_and_swap called with the two slots (low, high) of each comparator in turn.
template <int M, class CompareAndSwap>
NUSSELT_HD inline void sort_bitonic(CompareAndSwap compare_and_swap) noexcept {
    using Network = BitonicNetwork<M>;
    constexpr int kCount = sizeof(Network::kComparators) / sizeof(Comparator);
    detail::for_each_comparator<Network>(compare_and_swap, std::make_integer_sequence<int, kCount>());
}

NUSSELT_NAMESPACE_END
