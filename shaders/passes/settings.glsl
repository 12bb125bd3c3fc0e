#ifndef NUSSELT_PASSES_SETTINGS_GLSL
#define NUSSELT_PASSES_SETTINGS_GLSL
/// The settings of a pipeline and of a frame, with the numbers of shaders/interface/settings.h.

#include "interface/settings.h"
#include "passes/scene.glsl"

layout(constant_id = kTechniqueConstant) const int kTechnique = 0;
layout(constant_id = kStrategiesConstant) const int kStrategies = 0;
layout(constant_id = kSamplerConstant) const int kSampler = 0;
layout(constant_id = kBrdfConstant) const int kBrdf = 0;
layout(constant_id = kEmissionSamplingConstant) const int kEmissionSampling = 0;

/// Whether a branch had no code for a setting. The renderer then reports an error, see report_unknown_setting().
bool has_unknown_setting = false;

void note_unknown_setting() { has_unknown_setting = true; }

bool is_known(int value, int count) { return value >= 0 && value < count; }

/// Notes settings whose numbers are none of the known values.
void check_settings() {
    bool all_known = is_known(kTechnique, kTechniqueCount) && is_known(kStrategies, kStrategiesCount) &&
                     is_known(frame.mis, kMisCount) && is_known(kSampler, kSamplerCount) && is_known(kBrdf, kBrdfCount) &&
                     is_known(kEmissionSampling, kEmissionSamplingCount);
    if (!all_known) note_unknown_setting();
}

#endif
