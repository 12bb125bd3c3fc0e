#ifndef NUSSELT_RELATED_BITONIC_NETWORK_GLSL
#define NUSSELT_RELATED_BITONIC_NETWORK_GLSL
// Follows include/nusselt/related/bitonic_network.h @ 1364ca911caf
/// NUSSELT_SORT_BITONIC(F): F(low, high) for each comparator in turn of a network that sorts the NUSSELT_MAX_VERTICES + 1
/// slots of a convex polygon. Twin of include/nusselt/related/bitonic_network.h, which explains the networks.

#include "../core/compatibility.glsl"

#if NUSSELT_MAX_VERTICES == 3
#define NUSSELT_SORT_BITONIC(F) F(0, 2) F(1, 3) F(0, 1) F(2, 3)
#elif NUSSELT_MAX_VERTICES == 4
#define NUSSELT_SORT_BITONIC(F) F(0, 1) F(0, 2) F(0, 3) F(0, 4) F(1, 3) F(2, 4) F(1, 2) F(3, 4)
#elif NUSSELT_MAX_VERTICES == 5
#define NUSSELT_SORT_BITONIC(F) F(0, 2) F(0, 4) F(1, 3) F(1, 5) F(2, 4) F(3, 5) F(0, 1) F(2, 3) F(4, 5)
#elif NUSSELT_MAX_VERTICES == 6
#define NUSSELT_SORT_BITONIC(F) \
    F(0, 1) F(0, 4) F(2, 6) F(3, 5) F(1, 5) F(2, 3) F(4, 6) F(1, 3) F(0, 2) F(1, 2) F(3, 4) F(5, 6)
#elif NUSSELT_MAX_VERTICES == 7
#define NUSSELT_SORT_BITONIC(F) \
    F(0, 4) F(1, 5) F(2, 6) F(3, 7) F(0, 2) F(4, 6) F(1, 3) F(5, 7) F(0, 1) F(2, 3) F(4, 5) F(6, 7)
#else
#define NUSSELT_SORT_BITONIC(F) \
    F(0, 3) F(0, 6) F(1, 4) F(5, 8) F(1, 7) F(2, 8) F(3, 6) F(2, 5) F(4, 7) F(0, 1) F(3, 4) F(6, 7) F(0, 2) \
    F(1, 2) F(3, 5) F(4, 5) F(6, 8) F(7, 8)
#endif

#endif
