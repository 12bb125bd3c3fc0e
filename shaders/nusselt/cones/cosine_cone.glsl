#ifndef NUSSELT_CONES_COSINE_CONE_GLSL
#define NUSSELT_CONES_COSINE_CONE_GLSL
// Follows include/nusselt/cones/cosine_cone.h @ a3d2146f6c28
/// Sampling of the part of any elliptic cone above the horizon in proportion to the cosine at the surface. Twin of
/// include/nusselt/cones/cosine_cone.h.

#include "../cones/whole_cone.glsl"

/// The part of an elliptic cone above the horizon, whether or not the horizon cuts it.
struct CosineCone {
    bool is_whole;
    WholeCone whole;
    ConeSweep sweep; ///< only where the horizon cuts the cone
};

CosineCone make_cosine_cone(const EllipticCone cone) {
    CosineCone self;
    self.is_whole = is_above_horizon(cone);
    self.whole = make_whole_cone(cone);
    // The sweep is costly to prepare, and seldom needed.
    if (!self.is_whole) self.sweep = make_cone_sweep(cone);
    return self;
}

ConeSample cosine_cone_sample(const CosineCone self, vec2 u) {
    if (self.is_whole) return whole_cone_sample(self.whole, u);
    return cone_sweep_sample(self.sweep, u);
}

/// The density of a unit direction in the cone over its cosine, wi.z [1/sr].
float cosine_cone_density_per_cosine(const CosineCone self, vec3 wi) {
    if (self.is_whole) return self.whole.inverse_measure;
    return cone_sweep_density_per_cosine(self.sweep, wi);
}

vec2 cosine_cone_invert(const CosineCone self, vec3 wi) {
    if (self.is_whole) return whole_cone_invert(self.whole, wi);
    return cone_sweep_invert(self.sweep, wi);
}

/// Projected solid angle of the part above the horizon [sr].
float cosine_cone_measure(const CosineCone self) {
    return self.is_whole ? self.whole.measure : self.sweep.measure;
}

#endif
