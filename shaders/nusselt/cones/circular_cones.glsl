#ifndef NUSSELT_CONES_CIRCULAR_CONES_GLSL
#define NUSSELT_CONES_CIRCULAR_CONES_GLSL
// Follows include/nusselt/cones/elliptic_cone.h @ 43bf7dcc8ed2
/// The cones of spheres and disks without iteration. Twin of the second half of include/nusselt/cones/elliptic_cone.h.

#include "../cones/elliptic_cone.glsl"

/// The cone of a sphere: circular.
/// \param frame  its normal leads to the centre.
/// \param sine   radius over distance of the centre, at most 1.
/// \param cosine sqrt(1 - sine^2)
EllipticCone cone_of_circle(const Frame frame, float sine, float cosine) {
    float inverse = 1.0 / nusselt_max(nusselt_max(sine, cosine), kNusseltSmallestNormal);
    return EllipticCone(frame.t, frame.b, frame.n, inverse * sine, inverse * sine, inverse * cosine, vec3(1.0, 0.0, 0.0),
                        vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0), sine > 0.0);
}

/// Perpendicular directions in the plane of a disk: from the foot of the origin to the centre, and across.
struct DiskDirections {
    vec3 along, across;
};

/// \param normal unit, either side.
DiskDirections disk_directions(vec3 centre, vec3 normal) {
    vec3 side = nusselt_cross(normal, centre);
    // Next to the axis, the direction of denormal numbers would be one of rounding.
    vec3 across = nusselt_length(side) > kNusseltTiny ? nusselt_normalize(side) : frame_from_normal(normal).t;
    return DiskDirections(nusselt_cross(across, normal), across);
}

/// The cone of a disk with the semi-diameters radius * along and radius * across of disk_directions(). A single boost along the
/// first. Lengths to the nearest and the farthest point of the rim give all parameters without cancellation, edge-on, near and
/// far.
/// \param centre, radius of order one.
/// \param normal unit, either side.
EllipticCone cone_of_disk(vec3 centre, vec3 normal, float radius) {
    DiskDirections disk = disk_directions(centre, normal);
    float p = nusselt_length(nusselt_cross(normal, centre));
    float signed_height = dot(normal, centre);
    float h = abs(signed_height);
    // Squares that underflow belong to points on the rim.
    float near = sqrt(nusselt_fma(h, h, (p - radius) * (p - radius)));
    float far = sqrt(nusselt_fma(h, h, (p + radius) * (p + radius)));
    float distance = nusselt_length(centre);
    float power = (distance - radius) * (distance + radius);
    bool within = power < 0.0;

    // Half of the angle between the rays to the nearest and the farthest point.
    float across = 2.0 * radius * h;
    float along = near * far + abs(power);
    float norm = sqrt(nusselt_fma(across, across, along * along));
    bool visible = norm > 0.0 && near > 0.0 && radius > 0.0;
    float inverse_norm = 1.0 / (visible ? norm : 1.0);
    float product = visible ? near * far : 1.0;
    float sum = visible ? near + far : 1.0;
    float delta = (4.0 * radius * p) / (sum * sum); // the hyperbolic tangent of the rapidity
    float inverse_mean = 1.0 / sqrt(product);
    float gain = 0.5 * sum * inverse_mean;

    EllipticCone cone;
    cone.a = (within ? along : across) * inverse_norm;
    cone.c = (within ? across : along) * inverse_norm;
    cone.b = radius * inverse_mean;

    // The bisector of both rays. From afar the height of the centre has to survive; close by, the direction of the normal.
    bool over_disk = p < radius;
    float lateral = over_disk ? over_positive(4.0 * h * radius * p, (p + radius) * near + (radius - p) * far)
                              : (p - radius) * far + (p + radius) * near;
    float upright = copysign(over_disk ? sum : h * sum, signed_height);
    vec3 axis = within ? lateral * disk.along + upright * normal : centre - (delta * radius) * disk.along;
    axis = nusselt_normalize(axis);
    cone.e3 = dot(axis, axis) > 0.0 ? axis : normal;
    // The axis keeps its height; the others are perpendicular to it.
    cone.e1 = nusselt_normalize(nusselt_cross(disk.across, cone.e3));
    cone.e2 = nusselt_cross(cone.e3, cone.e1);
    float flip = dot(cone.e1, disk.along) < 0.0 ? -1.0 : 1.0;
    cone.row0 = vec3(flip * gain, 0.0, -gain * delta);
    cone.row1 = vec3(0.0, 1.0, 0.0);
    cone.row2 = vec3(-flip * gain * delta, 0.0, gain);
    cone.is_visible = visible && is_finite(norm);
    float inverse = 1.0 / nusselt_max(nusselt_max(cone.a, cone.b), nusselt_max(cone.c, kNusseltSmallestNormal));
    cone.a = without_tiny(inverse * cone.a);
    cone.b = without_tiny(inverse * cone.b);
    cone.c = without_tiny(inverse * cone.c);
    return cone;
}

#endif
