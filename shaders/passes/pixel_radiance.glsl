/// The entry point of shading passes: adds one frame, the radiance along one camera ray per pixel. The pass must define
/// before:
///
///     vec3 reflected_light(Surface surface, ivec2 pixel, inout Counts counts): the radiance that a surface reflects to
///     the camera.

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, int(frame.first_row));
    if (!has_pixel(pixel)) return;
    uint number = drawn_numbers[pixel_index(pixel)];
    Ray ray = camera_ray(pixel);
    bool is_first = frame.first_light == 0u && frame.first_sample == 0u;
    if (number == 0u) {
        if (kHasEnvironments && is_first) add_to_pixel(pixel, frame.weight * background(ray));
        return;
    }
    check_settings();
    DrawnTriangle drawn = drawn_triangle(number - 1u);
    vec3 radiance = is_first ? emission_of(drawn, ray) : vec3(0.0);
    if (drawn.is_surface) {
        Surface surface = make_surface(drawn, ray);
        Counts counts = Counts(0u, 0u);
        if (surface.valid) radiance += reflected_light(surface, pixel, counts);
        add_counts(counts);
    }
    add_to_pixel(pixel, frame.weight * radiance);
    note_unfinished();
    report_unknown_setting();
}
