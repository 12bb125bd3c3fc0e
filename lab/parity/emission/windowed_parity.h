#pragma once
/// Parity of techniques for polygons whose radiance depends on the direction. Their lights are made here: those of the
/// other techniques shine alike in all directions.

#include "lab/parity/parity_check.h"
#include "lab/parity/shader_platform.h"

#include <vector>

namespace nusselt::parity {

/// The techniques of nusselt/emission/windowed_polygon.h.
enum class WindowedTechnique { diffuse, on_lobe };

/// Judges shaders of one technique on all classes of lights, with about `count` scenes in total.
/// \return a verdict for each shader
std::vector<Verdict> judge_windowed(const ShaderPlatform& platform, WindowedTechnique technique,
                                    const std::vector<VariantShader>& shaders, int count);

} // namespace nusselt::parity
