// Columns with the numbers of lights, and how often a technique is timed in each thread. Included by the entry points
// after the technique.

layout(local_size_x = 64) in;
layout(constant_id = 1) const uint kLightCount = 1u;  // prepared by each thread
layout(constant_id = 2) const uint kSampleCount = 1u; // of each light
layout(set = 0, binding = 0, std430) readonly buffer Lights { float columns[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Sums { vec4 sums[]; };

// As kTimedLights in C++: columns have a value for each light.
const uint kLights = 256u;

float column(uint index, uint light) { return columns[kLights * index + light]; }
vec3 column_vec3(uint index, uint light) {
    return vec3(column(index, light), column(index + 1u, light), column(index + 2u, light));
}

// The multiplier of M. O'Neill 2014, PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
// Random Number Generation. As the baseline uses the same numbers, quality does not matter.
float next_random(inout uint state) {
    state = state * 747796405u + 2891336453u;
    return float(state >> 8) * 5.9604644775390625e-8;
}

vec4 summary(const LightSample s) { return vec4(s.wi + s.p, s.pdf); }
