#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_ray_query : require
/// sample_lights.glsl with shadow rays that the driver traces (ray queries).

#include "interface/fused_fma.h"
#include "interface/query.h"
#include "passes/alpha.glsl"

layout(set = 0, binding = kFirstBindingAfterLights + 5, std430) readonly buffer QueryInstances { QueryInstance query_instances[]; };
layout(set = 0, binding = kFirstBindingAfterLights + 6, std430) readonly buffer QueryPartials { uint query_partial_triangles[]; };
layout(set = 0, binding = kFirstBindingAfterLights + 7) uniform accelerationStructureEXT query_scene;

#include "passes/trace_query.glsl"
#include "passes/sample_lights.glsl"
