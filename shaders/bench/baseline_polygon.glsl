// A technique of practically no cost that reads all of a light: what remains is loading, looping and storing.
#include "nusselt/core/light_sample.glsl"
#include "nusselt/geometry/convex_polygon.glsl"

struct BaselinePolygon {
    vec3 sum;
};

BaselinePolygon baseline_polygon_prepare(ConvexPolygon light) {
    vec3 sum = light.normal;
    for (int j = 0; j < kNusseltSlots; ++j) sum += light.vertex[j] + light.edge[j];
    return BaselinePolygon(sum);
}

LightSample baseline_polygon_sample(BaselinePolygon self, vec2 u) {
    return LightSample(self.sum, u.x + u.y, self.sum);
}
