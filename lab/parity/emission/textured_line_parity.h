#pragma once
/// Parity of techniques for lines and tubes whose radiance varies along them. Their lights are made here: those of the other
/// techniques show nothing.

#include "lab/parity/parity_check.h"
#include "lab/parity/shader_platform.h"

#include <vector>

namespace nusselt::parity {

/// The techniques of nusselt/line_emission/textured_line.h and textured_tube.h for shaders.
enum class TexturedLineTechnique { line, line_on_lobe, tube, tube_on_lobe };

/// Judges shaders of one technique on all classes of lights, with about `count` lights in total.
/// \return a verdict for each shader
std::vector<Verdict> judge_textured_lines(const ShaderPlatform& platform, TexturedLineTechnique technique,
                                          const std::vector<VariantShader>& shaders, int count);

} // namespace nusselt::parity
