// Columns of ellipses and ellipsoids: the centre and semi-diameters. Both have those of an ellipsoid.
#include "bench/workload.glsl"

const uint kEllipsoidColumns = 12u;

Ellipsoid column_ellipsoid(uint index, inout vec4 sum) {
    Ellipsoid light = Ellipsoid(column_vec3(0u, index), column_vec3(3u, index), column_vec3(6u, index),
                                column_vec3(9u, index));
    sum.xyz += light.center + light.axis0 + light.axis1 + light.axis2;
    return light;
}

Ellipse column_ellipse(uint index, inout vec4 sum) {
    const Ellipsoid light = column_ellipsoid(index, sum);
    return Ellipse(light.center, light.axis0, light.axis1);
}
