#ifndef NUSSELT_GEOMETRY_SORTING_NETWORK_GLSL
#define NUSSELT_GEOMETRY_SORTING_NETWORK_GLSL
// Follows include/nusselt/geometry/sorting_network.h @ 0cef526b61d4
/// NUSSELT_SORT_BY_NETWORK(F): F(low, high) for each comparator in turn of a network that sorts the
/// NUSSELT_MAX_VERTICES + 1 slots of a polygon. F is a function-like macro; low and high are literals. Twin of
/// include/nusselt/geometry/sorting_network.h, where the sources of the networks stand.

#include "../core/compatibility.glsl"

#if NUSSELT_MAX_VERTICES == 3
#define NUSSELT_SORT_BY_NETWORK(F) F(0, 2) F(1, 3) F(0, 1) F(2, 3) F(1, 2)
#elif NUSSELT_MAX_VERTICES == 4
#define NUSSELT_SORT_BY_NETWORK(F) F(0, 3) F(1, 4) F(0, 2) F(1, 3) F(0, 1) F(2, 4) F(1, 2) F(3, 4) F(2, 3)
#elif NUSSELT_MAX_VERTICES == 5
#define NUSSELT_SORT_BY_NETWORK(F) \
    F(0, 5) F(1, 3) F(2, 4) F(1, 2) F(3, 4) F(0, 3) F(2, 5) F(0, 1) F(2, 3) F(4, 5) F(1, 2) F(3, 4)
#elif NUSSELT_MAX_VERTICES == 6
#define NUSSELT_SORT_BY_NETWORK(F) \
    F(0, 6) F(2, 3) F(4, 5) F(0, 2) F(1, 4) F(3, 6) F(0, 1) F(2, 5) F(3, 4) F(1, 2) F(4, 6) F(2, 3) F(4, 5) \
    F(1, 2) F(3, 4) F(5, 6)
#elif NUSSELT_MAX_VERTICES == 7
#define NUSSELT_SORT_BY_NETWORK(F) \
    F(0, 2) F(1, 3) F(4, 6) F(5, 7) F(0, 4) F(1, 5) F(2, 6) F(3, 7) F(0, 1) F(2, 3) F(4, 5) F(6, 7) F(2, 4) \
    F(3, 5) F(1, 4) F(3, 6) F(1, 2) F(3, 4) F(5, 6)
#elif NUSSELT_MAX_VERTICES == 8
#define NUSSELT_SORT_BY_NETWORK(F) \
    F(0, 3) F(1, 7) F(2, 5) F(4, 8) F(0, 7) F(2, 4) F(3, 8) F(5, 6) F(0, 2) F(1, 3) F(4, 5) F(7, 8) F(1, 4) \
    F(3, 6) F(5, 7) F(0, 1) F(2, 4) F(3, 5) F(6, 8) F(2, 3) F(4, 5) F(6, 7) F(1, 2) F(3, 4) F(5, 6)
#else
#define NUSSELT_SORT_BY_NETWORK(F) \
    F(0, 8) F(1, 9) F(2, 7) F(3, 5) F(4, 6) F(0, 2) F(1, 4) F(5, 8) F(7, 9) F(0, 3) F(2, 4) F(5, 7) F(6, 9) F(0, 1) \
    F(3, 6) F(8, 9) F(1, 5) F(2, 3) F(4, 8) F(6, 7) F(1, 2) F(3, 5) F(4, 6) F(7, 8) F(2, 3) F(4, 5) F(6, 7) F(3, 4) \
    F(5, 6)
#endif

#endif
