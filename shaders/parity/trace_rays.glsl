/// Traces rays from a buffer, past triangles and round lights. An entry point declares what its way to trace rays
/// needs, then includes this file and the way.

#include "interface/lights.h"

/// As passes/rounds/round_records.glsl has it for scenes with such lights.
#define ROUND_LIGHTS 1
const bool kHasRounds = true;

struct Ray {
    float origin[3];
    float direction[3];
    float t_far;
};

/// Coordinates of a triangle's corners in a texture that is 0 on the left and 1 on the right, and what it is multiplied by.
struct Alpha {
    float uv[6];
    float factor;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Rays { Ray rays[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { uint results[]; };
layout(set = 0, binding = 2, std430) readonly buffer Alphas { Alpha alphas[]; };
layout(set = 0, binding = 3, std430) readonly buffer Rounds { RoundLightRecord round_lights[]; };
layout(push_constant) uniform Push { uint ray_count; };

bool occluded(vec3 origin, vec3 direction, float t_far);

float alpha_at(uint triangle, vec2 barycentrics, uint instance) {
    float a = alphas[triangle].uv[0];
    float b = alphas[triangle].uv[2];
    float c = alphas[triangle].uv[4];
    float u = a + barycentrics.x * (b - a) + barycentrics.y * (c - a);
    return u < 0.5 ? 0.0 : alphas[triangle].factor;
}

/// Round lights have no alpha textures here.
float alpha_on_round(uint triangle, vec2 uv) { return alphas[triangle].factor; }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= ray_count) return;
    vec3 origin = vec3(rays[i].origin[0], rays[i].origin[1], rays[i].origin[2]);
    vec3 direction = vec3(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
    results[i] = occluded(origin, direction, rays[i].t_far) ? 1u : 0u;
}
