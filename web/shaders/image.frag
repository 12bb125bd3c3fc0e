/// Adds what the camera sees in a frame to the sum of the frames before.

@includes@
uniform highp sampler2D frames_before;

out vec4 frames; ///< their sum, and how many samples were not finite

vec3 reflected_light(Surface surface) {
    Reflection reflection = @reflection_of@(surface);
    vec3 reflected = vec3(0.0);
@loops@    return reflected;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int number = texelFetch(visible_numbers, pixel, 0).x;
    vec3 radiance = vec3(0.0);
    if (number >= 0) {
        Surface surface = surface_at(number);
        radiance = emission_of(surface);
        if (surface.material.model != kNoSurface) radiance += reflected_light(surface);
    }
    frames = texelFetch(frames_before, pixel, 0) + vec4(radiance, @rejected@);
}
