#pragma once
/// Blue noise by the void-and-cluster method.

#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::fit {

/// The ranks of the pixels of a square that repeats in both directions, row by row: a permutation of the numbers below
/// side * side. Of the pixels with the lowest ranks, however many, few are close to each other. R. Ulichney 1993, The
/// void-and-cluster method for dither array generation, Proc. SPIE 1913.
///
/// Energies are sums of integers, so the result does not depend on the machine.
/// \param side  of the square [pixels], 2 to 256. The time grows with its fourth power.
/// \param sigma standard deviation of the Gaussian that measures how crowded a pixel is [pixels], above 0. Ulichney's 1.5
///              leaves 7 % of the power of white noise between 0.2 and 0.3 cycles per pixel and 0.4 % below that; 1.9
///              leaves 30 % and 0.4 %.
/// \param seed  of the first pattern.
std::vector<std::uint16_t> void_and_cluster(int side, double sigma, std::uint64_t seed);

/// The bytes that a BlueNoiseView views, in a few seconds: a square for each channel.
/// \param sigma as for void_and_cluster().
/// \param seed  files with different seeds, below 2^61, have no square in common.
std::string make_blue_noise(double sigma, std::uint64_t seed);

} // namespace nusselt::fit
