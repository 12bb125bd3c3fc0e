#ifndef NUSSELT_EMISSION_TEXTURE_PLANE_GLSL
#define NUSSELT_EMISSION_TEXTURE_PLANE_GLSL
// Follows include/nusselt/emission/texture_plane.h @ f0fea842cd96
/// Where a texture lies in space. Twin of include/nusselt/emission/texture_plane.h.

#include "../core/frame.glsl"

/// An affine map from texture coordinates to a plane in space.
struct TexturePlane {
    vec3 corner; ///< texture coordinates (0, 0) [m]
    vec3 side_x; ///< from (0, 0) to (1, 0) [m]
    vec3 side_y; ///< from (0, 0) to (0, 1) [m]
    vec3 normal; ///< unit, right-handed with the sides; zero if they do not span a plane
};

/// The vector between two points whose texture coordinates differ by this much.
vec3 texture_plane_offset_of(const TexturePlane self, vec2 difference) {
    return nusselt_fma(difference.y, self.side_y, difference.x * self.side_x);
}

vec3 texture_plane_point_at(const TexturePlane self, vec2 at) {
    return self.corner + texture_plane_offset_of(self, at);
}

/// Area of the texture [m^2].
float texture_plane_area(const TexturePlane self) { return nusselt_length(nusselt_cross(self.side_x, self.side_y)); }

/// \param corner, side_x, side_y see TexturePlane.
TexturePlane make_texture_plane(vec3 corner, vec3 side_x, vec3 side_y) {
    // Unit sides have products in range.
    return TexturePlane(corner, side_x, side_y,
                        nusselt_normalize(nusselt_cross(nusselt_normalize(side_x), nusselt_normalize(side_y))));
}

/// The plane seen from a shading point: the point becomes the origin, the normal of the frame +z.
TexturePlane to_shading_space(const TexturePlane world, vec3 point, const Frame frame) {
    return TexturePlane(frame_to_local(frame, world.corner - point), frame_to_local(frame, world.side_x),
                        frame_to_local(frame, world.side_y), frame_to_local(frame, world.normal));
}

/// Texture coordinates in [0, 1) of a point of the plane.
vec2 texture_plane_coordinates(const TexturePlane self, vec3 p) {
    // Vectors whose products with one side are 1 and with the other one 0, from sides of order one.
    float scale =
        reciprocal_power_of_two(nusselt_max(largest_component(self.side_x), largest_component(self.side_y)));
    vec3 x = scale * self.side_x;
    vec3 y = scale * self.side_y;
    vec3 n = nusselt_cross(x, y);
    float squared = dot(n, n);
    float factor = squared > 0.0 ? scale / squared : 0.0;
    vec3 offset = p - self.corner;
    return vec2(below_one(dot(factor * nusselt_cross(y, n), offset)),
                below_one(dot(factor * nusselt_cross(n, x), offset)));
}

#endif
