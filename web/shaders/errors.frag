/// Sums up the squared errors of both images from the reference over blocks of pixels.

#include "nusselt/core/compatibility.glsl"

uniform highp sampler2D left_frames;
uniform highp sampler2D right_frames;
uniform highp sampler2D reference_frames;
uniform float left_count, right_count, reference_count; ///< of frames

const int kBlock = @error_block@;

/// Squared errors over all channels of the left and of the right image, and how many samples of all images were not
/// finite. Errors of images without frames, and from a reference without, mean nothing.
out vec4 errors;

void main() {
    ivec2 begin = kBlock * ivec2(gl_FragCoord.xy);
    ivec2 end = min(begin + kBlock, textureSize(reference_frames, 0));
    vec3 counts = vec3(left_count, right_count, reference_count);
    vec3 scale = 1.0 / max(counts, 1.0);
    vec3 exists = min(counts, 1.0);
    vec3 sum = vec3(0.0);
    for (int y = begin.y; y < end.y; ++y) {
        for (int x = begin.x; x < end.x; ++x) {
            vec4 left_sum = texelFetch(left_frames, ivec2(x, y), 0);
            vec4 right_sum = texelFetch(right_frames, ivec2(x, y), 0);
            vec4 reference_sum = texelFetch(reference_frames, ivec2(x, y), 0);
            vec3 left = scale.x * left_sum.xyz - scale.z * reference_sum.xyz;
            vec3 right = scale.y * right_sum.xyz - scale.z * reference_sum.xyz;
            vec3 rejected = vec3(left_sum.w, right_sum.w, reference_sum.w);
            sum += vec3(dot(left, left), dot(right, right), dot(exists, rejected));
        }
    }
    errors = vec4(sum, 0.0);
}
