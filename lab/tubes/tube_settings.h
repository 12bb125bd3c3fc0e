#pragma once
/// Settings of the renderer for images of tubes. Rays through the centres of pixels leave the light as the only source of
/// errors.

#include "render/settings.h"

namespace nusselt::lab {

/// Tubes as their models say, sampled with the BRDF itself.
render::RenderSettings sampled_tubes(int samples);

/// Tubes as lines against the fitted lobe, without noise.
render::RenderSettings analytic_tubes();

} // namespace nusselt::lab
