// A technique of practically no cost; all that is loaded of the lobe counts elsewhere.
#include "bench/baselines/cylinder.glsl"
#include "nusselt/ltc/ltc.glsl"

BaselineCylinder baseline_cylinder_on_lobe_prepare(const Cylinder light, const Ltc lobe) {
    return baseline_cylinder_prepare(light);
}

LightSample baseline_cylinder_on_lobe_sample(const BaselineCylinder self, vec2 u) {
    return baseline_cylinder_sample(self, u);
}
