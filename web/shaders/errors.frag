/// Sums up the squared errors of both images from the reference over blocks of pixels.

#include "nusselt/core/compatibility.glsl"

uniform highp sampler2D left_frames;
uniform highp sampler2D right_frames;
uniform highp sampler2D reference_frames;

const int kBlock = 16;

out vec4 errors; ///< over all channels, of the left and of the right image

vec3 mean_of(vec4 frames) { return frames.w > 0.0 ? frames.xyz / frames.w : vec3(0.0); }

void main() {
    ivec2 begin = kBlock * ivec2(gl_FragCoord.xy);
    ivec2 end = min(begin + kBlock, textureSize(reference_frames, 0));
    vec2 sum = vec2(0.0);
    for (int y = begin.y; y < end.y; ++y) {
        for (int x = begin.x; x < end.x; ++x) {
            vec3 reference = mean_of(texelFetch(reference_frames, ivec2(x, y), 0));
            vec3 left = mean_of(texelFetch(left_frames, ivec2(x, y), 0)) - reference;
            vec3 right = mean_of(texelFetch(right_frames, ivec2(x, y), 0)) - reference;
            sum += vec2(dot(left, left), dot(right, right));
        }
    }
    errors = vec4(sum, 0.0, 0.0);
}
