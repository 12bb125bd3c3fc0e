#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
/// sample_lights.glsl without shadow rays: surfaces see all lights.

bool occluded(vec3 origin, vec3 direction, float t_far) { return false; }

#include "interface/fused_fma.h"
#include "passes/sample_lights.glsl"
