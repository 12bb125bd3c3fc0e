#pragma once
/// Pictures of how techniques map random numbers to a light.

#include <nusselt/core/vec.h>

#include <string>
#include <string_view>
#include <vector>

namespace nusselt::lab {

/// Class names of the techniques that draw_sampling_map() supports.
std::vector<std::string> mapped_techniques();

/// An SVG with a panel per kind of configuration, as seen from the shading point: directions are projected to the
/// unit disk along the normal, so that areas in the picture are projected solid angles. Polygons get the image of a
/// regular grid of random numbers and of blue noise, lines the image of equal steps of the random number. What lies
/// below the horizon is left out, its share is written under the panel. Deterministic.
/// \param technique a class name out of mapped_techniques(). \throws std::runtime_error for any other.
std::string draw_sampling_map(std::string_view technique);

/// Points in [0, 1)^2 that keep apart from each other, also across the borders of the square: each one is the best of
/// many candidates. Deterministic.
/// \param count at least 1; the time grows with its cube.
std::vector<Vec2<double>> blue_noise_points(int count);

} // namespace nusselt::lab
