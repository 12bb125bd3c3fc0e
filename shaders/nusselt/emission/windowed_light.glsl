#ifndef NUSSELT_EMISSION_WINDOWED_LIGHT_GLSL
#define NUSSELT_EMISSION_WINDOWED_LIGHT_GLSL
// Follows include/nusselt/emission/windowed_light.h @ 3dd7e5945911
// Follows include/nusselt/emission/windowed_light_words.h @ 0c4314ffd992
/// Polygons whose radiance depends on the direction and not on the point: portals of environment maps, and lights with a
/// profile. Twin of include/nusselt/emission/windowed_light.h. make_portal() and make_profiled_light() of C++ prepare
/// lights, and WindowedLightWords writes them as words (rectified_table.glsl). A light is known by the number of its
/// first word.

#include "../core/frame.glsl"
#include "../emission/rectified_table.glsl"

// Where the parts of a light begin: those of WindowedLightWords in C++.
const uint kNusseltWindowedTable = 0u;
const uint kNusseltWindowedVertices = 1u;
const uint kNusseltWindowedCorner = 2u;
const uint kNusseltWindowedFrame = 5u;
const uint kNusseltWindowedOutline = 14u;

/// The plane of a light. Slopes are those of directions to the light in the frame: x over z, y over z.
struct WindowPlane {
    vec3 corner; ///< where coordinates in the plane are zero [m]
    Frame frame; ///< orthogonal unit vectors, in either handedness; the normal leads away from points that see the light
};

/// The plane seen from a shading point: the point becomes the origin, the normal of the frame +z.
WindowPlane to_shading_space(const WindowPlane world, vec3 point, const Frame frame) {
    return WindowPlane(frame_to_local(frame, world.corner - point),
                       Frame(frame_to_local(frame, world.frame.t), frame_to_local(frame, world.frame.b),
                             frame_to_local(frame, world.frame.n)));
}

/// The first word of the table of a light, which others may share.
uint windowed_light_table(uint light) { return windowed_light_word(light + kNusseltWindowedTable); }
/// The plane in world space.
WindowPlane windowed_light_plane(uint light) {
    uint frame = light + kNusseltWindowedFrame;
    return WindowPlane(
        windowed_light_vec3(light + kNusseltWindowedCorner),
        Frame(windowed_light_vec3(frame), windowed_light_vec3(frame + 3u), windowed_light_vec3(frame + 6u)));
}
/// Number of vertices of the outline.
int windowed_light_vertices(uint light) { return int(windowed_light_word(light + kNusseltWindowedVertices)); }
/// A vertex in the plane [m], counter-clockwise.
vec2 windowed_light_vertex(uint light, int k) {
    return windowed_light_vec2(light + kNusseltWindowedOutline + 2u * uint(k));
}

#endif
