#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
/// sample_lights.glsl with shadow rays that traverse a hierarchy in buffers.

#include "interface/fused_fma.h"
#include "interface/bvh.h"
#include "passes/alpha.glsl"

layout(set = 0, binding = kFirstBindingAfterLights + 5, std430) readonly buffer BvhNodes { BvhNode bvh_nodes[]; };
layout(set = 0, binding = kFirstBindingAfterLights + 6, std430) readonly buffer BvhTriangles { BvhTriangle bvh_triangles[]; };
layout(set = 0, binding = kFirstBindingAfterLights + 7, std430) readonly buffer BvhInstances { BvhInstance bvh_instances[]; };

#include "passes/trace_bvh.glsl"
#include "passes/sample_lights.glsl"
