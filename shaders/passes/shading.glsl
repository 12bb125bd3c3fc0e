#ifndef NUSSELT_PASSES_SHADING_GLSL
#define NUSSELT_PASSES_SHADING_GLSL
/// The parts that all shading passes share: pixels, sums and counters.

#include "passes/lights.glsl"
#include "passes/settings.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = kFirstBindingAfterLights + 1, std430) readonly buffer Numbers { uint drawn_numbers[]; };
layout(set = 0, binding = kFirstBindingAfterLights + 2, std430) buffer Sums { PixelSum pixel_sums[]; };
layout(set = 0, binding = kFirstBindingAfterLights + 3, std430) buffer Work { WorkRecord work; };

bool has_pixel(ivec2 pixel) { return pixel.x < scene.width && pixel.y < scene.height; }
uint pixel_index(ivec2 pixel) { return uint(pixel.y) * uint(scene.width) + uint(pixel.x); }

/// Adds the weighted radiance along one camera ray to a pixel.
void add_to_pixel(ivec2 pixel, vec3 arriving) {
    uint index = pixel_index(pixel);
    vec3 sum = to_vec(pixel_sums[index].sum);
    precise vec3 corrected = arriving - to_vec(pixel_sums[index].excess);
    precise vec3 next = sum + corrected;
    precise vec3 excess = (next - sum) - corrected;
    for (int i = 0; i < 3; ++i) {
        pixel_sums[index].sum[i] = next[i];
        pixel_sums[index].excess[i] = excess[i];
    }
}

/// A sum with the error of a single rounding, however many terms there are (Kahan).
struct CompensatedSum {
    vec3 sum;
    vec3 excess; ///< by how much `sum` is too large
};

void compensated_sum_add(inout CompensatedSum self, vec3 term) {
    precise vec3 corrected = term - self.excess;
    precise vec3 next = self.sum + corrected;
    precise vec3 excess = (next - self.sum) - corrected;
    self.sum = next;
    self.excess = excess;
}

bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// The work that a pixel took.
struct Counts {
    uint shadow_rays;
    uint rejected_samples;
};

void add_counts(const Counts counts) {
    if (counts.shadow_rays > 0u) {
        uint before = atomicAdd(work.shadow_rays[0], counts.shadow_rays);
        if (before + counts.shadow_rays < before) atomicAdd(work.shadow_rays[1], 1u);
    }
    if (counts.rejected_samples > 0u) {
        uint before = atomicAdd(work.rejected_samples[0], counts.rejected_samples);
        if (before + counts.rejected_samples < before) atomicAdd(work.rejected_samples[1], 1u);
    }
}

/// Counts pixels whose loops the driver ended too early. Mesa's software device leaves all loops after 65535 rounds of all
/// loops of a shader together, and goes on as if they had finished.
void note_unfinished() {
    uint rounds = 0u;
    while (rounds < frame.loop_probe) ++rounds;
    if (rounds != frame.loop_probe) atomicAdd(work.unfinished, 1u);
}

/// Counts pixels that were shaded with a setting for which no branch has code.
void report_unknown_setting() {
    if (has_unknown_setting) atomicAdd(work.unknown_settings, 1u);
}

#endif
