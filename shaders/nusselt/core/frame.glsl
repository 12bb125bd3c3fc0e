#ifndef NUSSELT_CORE_FRAME_GLSL
#define NUSSELT_CORE_FRAME_GLSL
// Follows include/nusselt/core/frame.h @ 39bd8167eaab
/// Right-handed orthonormal frames. Shading space has the shading point as origin and the normal as +z. Twin of
/// include/nusselt/core/frame.h.

#include "../core/vec.glsl"

struct Frame {
    vec3 t; ///< x axis in world space
    vec3 b; ///< y axis
    vec3 n; ///< z axis
};

/// Completes a unit normal to a frame without branches or poles (Duff et al. 2017, JCGT 6(1)).
Frame frame_from_normal(vec3 normal) {
    float sgn = copysign(1.0, normal.z);
    float a = -1.0 / (sgn + normal.z);
    float c = normal.x * normal.y * a;
    return Frame(vec3(nusselt_fma(sgn * normal.x * normal.x, a, 1.0), sgn * c, -sgn * normal.x),
                 vec3(c, nusselt_fma(normal.y * normal.y, a, sgn), -normal.y), normal);
}

vec3 frame_to_local(const Frame self, vec3 world) {
    return vec3(dot(self.t, world), dot(self.b, world), dot(self.n, world));
}

vec3 frame_to_world(const Frame self, vec3 local) {
    return local.x * self.t + local.y * self.b + local.z * self.n;
}

#endif
