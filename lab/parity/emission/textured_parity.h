#pragma once
/// Parity of techniques for polygons with textures. Their lights are made here: those of the other techniques show
/// nothing.

#include "lab/parity/parity_check.h"
#include "lab/parity/shader_platform.h"

#include <vector>

namespace nusselt::parity {

/// The techniques of nusselt/emission/textured_polygon.h for shaders.
enum class TexturedTechnique { diffuse, on_lobe };

/// Judges shaders of one technique on all classes of lights, with about `count` lights in total.
/// \return a verdict for each shader
std::vector<Verdict> judge_textured(const ShaderPlatform& platform, TexturedTechnique technique,
                                    const std::vector<VariantShader>& shaders, int count);

} // namespace nusselt::parity
