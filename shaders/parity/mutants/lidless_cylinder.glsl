// A mutant that the comparison must reject: rays pass through the caps and end on the infinite lateral surface.
LightSample lidless_sample(const Technique technique, vec2 u) {
    LightSample s = technique_sample(technique, u);
    CylinderView view = technique.fan.image.view;
    CylinderSlice slice = cylinder_view_slice(view, cylinder_view_azimuth_of(view, s.wi), 0.0);
    s.p = technique.inverse_scale * slice.near / dot(s.wi, slice.t) * s.wi;
    return s;
}
#undef technique_sample
#define technique_sample lidless_sample
#include "parity/cylinder.glsl"
