// A technique of practically no cost: what remains is loading, looping and storing.
#include "nusselt/core/light_sample.glsl"
#include "nusselt/geometry/convex_polygon.glsl"

struct BaselinePolygon {
    vec3 normal;
};

BaselinePolygon baseline_polygon_prepare(const ConvexPolygon light) { return BaselinePolygon(light.normal); }

LightSample baseline_polygon_sample(const BaselinePolygon self, vec2 u) {
    return LightSample(self.normal, u.x + u.y, self.normal);
}
