#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_MEASURE_SAMPLES_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_MEASURE_SAMPLES_GLSL
/// Samples of polygonal lights as if all were uniform.

void add_polygon(inout Estimate estimate, const LocalPolygon light) { add_light(estimate, light); }

#endif
