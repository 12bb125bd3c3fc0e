#pragma once
/// Lines or points: what is faster depends on how many triangles may hide a light from a shading point. `nusselt-lab bench
/// line-efficiency` measures both, and what the choice between them loses.

#include "render/settings.h"

namespace nusselt::render {

/// Bound on the blocks of triangles in the pyramid of a shading point and a light (see has_many_occluders()): beyond it,
/// points reach the same error in less time.
/// \param lines per shading point and light
/// \returns -1 if points are better even without any occluder
int most_occluders_for_lines(int lines);

/// Points that are about as noisy as so many lines, since noise falls faster with the number of lines than of points. At
/// least 1, a power of two; bounded by what there are random numbers for.
/// \param lines       per shading point and light
/// \param camera_rays per pixel
int points_in_place_of_lines(int lines, int camera_rays);

} // namespace nusselt::render
