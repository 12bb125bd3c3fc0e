#version 450
#extension GL_GOOGLE_include_directive : require
/// Turns two accumulated images into the 8-bit pixels of a window, and sums up their squared errors from a reference.

#include "interface/display.h"
#include "interface/scene.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std430) readonly buffer LeftSums { PixelSum left_sums[]; };
layout(set = 0, binding = 1, std430) readonly buffer RightSums { PixelSum right_sums[]; };
layout(set = 0, binding = 2, std430) readonly buffer ReferenceSums { PixelSum reference_sums[]; };
/// Row by row from the top, with red in the lowest byte.
layout(set = 0, binding = 3, std430) writeonly buffer Shown { uint shown[]; };
/// For each work group the sums over its pixels and channels: for the left and for the right image.
layout(set = 0, binding = 4, std430) writeonly buffer Errors { vec2 squared_errors[]; };

layout(push_constant) uniform Push { DisplayRecord display; };

const uint kGroupSize = kDisplayGroupSide * kDisplayGroupSide;
shared vec2 group_errors[kGroupSize];

vec3 mean_of(const PixelSum sum, const ShownSums shown, uint row) {
    float scale = row < shown.rows_ahead ? shown.scale_ahead : shown.scale;
    return scale * vec3(sum.sum[0], sum.sum[1], sum.sum[2]);
}

/// Compresses radiance to what a display shows, see render_vulkan::ToneCurve.
vec3 tone_mapped(vec3 linear) {
    if (display.tone_curve == kToneCurveReinhard) return linear / (1.0 + dot(linear, vec3(0.2126, 0.7152, 0.0722)));
    if (display.tone_curve == kToneCurveFilmic) {
        // The quotient has the limit 2.51 / 2.43; beyond 1e4, its squares could overflow.
        vec3 x = min(linear, vec3(1e4));
        return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    }
    return linear;
}

/// The transfer function of sRGB for values that are clamped to [0, 1]. NaN becomes 0.
vec3 to_srgb(vec3 linear) {
    linear = mix(clamp(linear, 0.0, 1.0), vec3(0.0), isnan(linear));
    return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

/// The colour of a relative error: black up to a thousandth, then blue, magenta and orange, and white from 1 on and for
/// NaN.
vec3 error_colour(vec3 value, vec3 reference) {
    // References that a display shows as black count like the darkest grey.
    const float kDarkest = 0.005;
    vec3 difference = abs(value - reference);
    float relative = dot(difference, vec3(1.0)) / (dot(abs(reference), vec3(1.0)) + 3.0 * kDarkest);
    const vec3 kRamp[5] = vec3[5](vec3(0.0), vec3(0.1, 0.1, 0.6), vec3(0.75, 0.15, 0.6), vec3(1.0, 0.6, 0.1),
    vec3(1.0));
    bool is_small = relative < 1.0; // false for NaN
    float at = is_small ? 4.0 * clamp(1.0 + log2(max(relative, 1e-6)) / log2(1000.0), 0.0, 1.0) : 4.0;
    int cell = clamp(int(at), 0, 3);
    return mix(kRamp[cell], kRamp[cell + 1], at - float(cell));
}

uint to_bytes(vec3 colour) {
    uvec3 bytes = uvec3(255.0 * colour + 0.5);
    return bytes.x | bytes.y << 8 | bytes.z << 16 | 0xff000000u;
}

/// \returns the squared errors of the left and the right image, summed over channels
vec2 show(uvec2 pixel) {
    uint index = pixel.y * display.width + pixel.x;
    vec3 left = mean_of(left_sums[index], display.left, pixel.y);
    vec3 right = mean_of(right_sums[index], display.right, pixel.y);
    vec3 reference = mean_of(reference_sums[index], display.reference, pixel.y);
    vec3 seen = display.exposure * (pixel.x < display.wipe ? left : right);
    bool is_error = display.shows_error != 0u;
    shown[index] = to_bytes(is_error ? error_colour(seen, display.exposure * reference) : to_srgb(tone_mapped(seen)));
    left -= reference;
    right -= reference;
    return vec2(dot(left, left), dot(right, right));
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    bool has_pixel = pixel.x < display.width && pixel.y < display.height;
    uint lane = gl_LocalInvocationIndex;
    group_errors[lane] = has_pixel ? show(pixel) : vec2(0.0);
    for (uint step = kGroupSize / 2u; step > 0u; step /= 2u) {
        barrier();
        if (lane < step) group_errors[lane] += group_errors[lane + step];
    }
    if (lane == 0u) squared_errors[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = group_errors[0];
}
