#ifndef NUSSELT_EMISSION_SPREAD_GLSL
#define NUSSELT_EMISSION_SPREAD_GLSL
// Follows include/nusselt/emission/spread.h @ c56049367464
/// Grids in front of a flat light, which keep its radiance to directions near its normal. Twin of
/// include/nusselt/emission/spread.h. C++ makes tables, so that shares of the flux and domains are there only.

#include "../core/real.glsl"

/// Slopes of holes that tables can represent: the limits of C++ for slopes in tables.
const float kNusseltSteepestHole = 2.3283064365386963e-10; // 2^-32
const float kNusseltWidestHole = 4294967296.0;             // 2^32

/// A honeycomb with rectangular holes.
struct Honeycomb {
    vec2 slope; ///< width over depth of the holes; clamped to kNusseltSteepestHole and kNusseltWidestHole
};

/// The same share in all azimuths, 1 - tan(angle from the normal) / t: what Cycles calls spread.
struct RadialSpread {
    float slope; ///< t, from which on nothing passes; clamped likewise
};

float hole_slope(float slope) {
    return nusselt_min(nusselt_max(slope, kNusseltSteepestHole), kNusseltWidestHole);
}
/// The share of a hole that is visible across a pair of its walls.
float hole_share(float across, float along, float slope) {
    return nusselt_max(1.0 - abs(across) / (along * hole_slope(slope)), 0.0);
}

/// The share of radiance that passes in a unit direction of the frame of the light, whose z axis is its normal.
float honeycomb_share(const Honeycomb self, vec3 direction) {
    if (!(direction.z > 0.0)) return 0.0;
    return hole_share(direction.x, direction.z, self.slope.x) * hole_share(direction.y, direction.z, self.slope.y);
}
/// Likewise.
float radial_spread_share(const RadialSpread self, vec3 direction) {
    if (!(direction.z > 0.0)) return 0.0;
    return hole_share(sqrt(dot(direction.xy, direction.xy)), direction.z, self.slope);
}

#endif
