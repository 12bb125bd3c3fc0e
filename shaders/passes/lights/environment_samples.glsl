#ifndef NUSSELT_PASSES_LIGHTS_ENVIRONMENT_SAMPLES_GLSL
#define NUSSELT_PASSES_LIGHTS_ENVIRONMENT_SAMPLES_GLSL
/// Samples of environments without a portal, in the shaders that scenes with such lights have. Those of portals are in
/// polygon_samples.glsl.

#if EMISSION_CELLS
#include "passes/cells/environment_cell_samples.glsl"
#else
void add_environments(inout Estimate estimate) {}
#endif

#endif
