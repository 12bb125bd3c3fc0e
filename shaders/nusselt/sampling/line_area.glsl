#ifndef NUSSELT_SAMPLING_LINE_AREA_GLSL
#define NUSSELT_SAMPLING_LINE_AREA_GLSL
// Follows include/nusselt/sampling/line_area.h @ 84c338ac7441
/// Uniform sampling of the length of a linear light. It needs no trigonometry, but is noisy close to the light. Twin of
/// include/nusselt/sampling/line_area.h.
///
/// Measure: pdf is the density of wi in solid angle times the radius of the cylinder that tends to 0 [m/sr]:
/// |p|^2 / (2 length |wi x s|). The emission of the light is radiance times radius, so that the radius cancels (Peters
/// 2021, linear lights, Sec. 3.1). Space: any frame with the shading point as origin; no clipping, so that wi may point
/// below the horizon. Edge cases: no length, or origin on the infinite line: pdf = 0.

#include "../core/light_sample.glsl"
#include "../geometry/line_segment.glsl"

struct LineArea {
    LineSegment light;
    float distance; ///< of the infinite line from the origin [m]
};

/// \param light relative to the shading point [m].
LineArea line_area_prepare(const LineSegment light) {
    return LineArea(light, nusselt_length(nusselt_cross(light.p0, light.s)));
}

/// Length of the light [m].
float line_area_measure(const LineArea self) { return self.light.len; }

/// \param r    distance of the point.
/// \param sine of the angle between wi and the line.
float line_area_density(const LineArea self, float r, float sine) {
    return area_density(r, 2.0 * self.light.len * sine);
}

/// \param u in [0, 1), proportional to the distance from the start.
LightSample line_area_sample(const LineArea self, float u) {
    vec3 p = self.light.p0 + (u * self.light.len) * self.light.s;
    float r = nusselt_length(p);
    // |wi x s| = distance / r; from wi it would lose its precision where the light is seen end-on.
    return LightSample(nusselt_normalize(p), line_area_density(self, r, self.distance / (r > 0.0 ? r : 1.0)), p);
}

/// \param wi a unit direction towards the light.
float line_area_pdf(const LineArea self, vec3 wi) {
    float sine = nusselt_length(nusselt_cross(wi, self.light.s));
    return line_area_density(self, self.distance / (sine > 0.0 ? sine : 1.0), sine);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_area_invert(const LineArea self, vec3 wi) {
    float start = dot(self.light.p0, self.light.s);
    float along = dot(wi, self.light.s);
    float sine = nusselt_length(nusselt_cross(wi, self.light.s));
    float coordinate = self.distance * along / (sine > 0.0 ? sine : 1.0) - start;
    return below_one(coordinate / (self.light.len > 0.0 ? self.light.len : 1.0));
}

#endif
