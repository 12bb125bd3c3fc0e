#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
// Shadow rays by ray queries.
#include "parity/trace_rays.glsl"
#include "passes/scene_kinds.glsl"
#include "interface/query.h"

layout(set = 0, binding = 4, std430) readonly buffer Instances { QueryInstance query_instances[]; };
layout(set = 0, binding = 5, std430) readonly buffer Partial { uint query_partial_triangles[]; };
layout(set = 0, binding = 6) uniform accelerationStructureEXT query_scene;

#include "passes/trace_query.glsl"
