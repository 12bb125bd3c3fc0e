#version 450
#extension GL_GOOGLE_include_directive : require
// Shadow rays by the hierarchy in buffers.
#include "parity/trace_rays.glsl"
#include "passes/scene_kinds.glsl"
#include "interface/bvh.h"

layout(set = 0, binding = 4, std430) readonly buffer Nodes { BvhNode bvh_nodes[]; };
layout(set = 0, binding = 5, std430) readonly buffer Triangles { BvhTriangle bvh_triangles[]; };
layout(set = 0, binding = 6, std430) readonly buffer Instances { BvhInstance bvh_instances[]; };

#include "passes/trace_bvh.glsl"
