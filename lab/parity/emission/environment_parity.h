#pragma once
/// Parity of techniques for environment maps. They are made here: lights of the other techniques have no radiance.

#include "lab/parity/parity_check.h"
#include "lab/parity/shader_platform.h"

#include <vector>

namespace nusselt::parity {

/// The techniques of nusselt/emission/environment_sampling.h.
enum class EnvironmentTechnique { cosine, on_lobe };

/// Judges shaders of one technique on all classes of maps and surfaces, with about `count` surfaces in total.
/// \return a verdict for each shader
std::vector<Verdict> judge_environment(const ShaderPlatform& platform, EnvironmentTechnique technique,
                                       const std::vector<VariantShader>& shaders, int count);

} // namespace nusselt::parity
