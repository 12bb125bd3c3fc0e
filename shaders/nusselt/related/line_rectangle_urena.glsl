#ifndef NUSSELT_RELATED_LINE_RECTANGLE_URENA_GLSL
#define NUSSELT_RELATED_LINE_RECTANGLE_URENA_GLSL
// Follows include/nusselt/related/line_rectangle_urena.h @ 7e14205800ef
/// A method to compare with: a thin rectangle in place of a linear light, as renderers use it that have rectangles but
/// no linear lights.
///
/// C. Ureña, M. Fajardo, A. King 2013, An Area-Preserving Parametrization for Spherical Rectangles, CGF 32(4),
/// doi:10.1111/cgf.12151. Use line_solid_angle.glsl instead. Twin of include/nusselt/related/line_rectangle_urena.h,
/// where the bias stands.
///
/// Measure and space as line_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../geometry/clip_line.glsl"
#include "../related/rectangle_polygon.glsl"
#include "../sampling/rectangle_solid_angle.glsl"

/// Half the width over the distance of the line: 2^-12. Its square is the rounding error.
const float kNusseltThinness = 0.000244140625;

struct LineRectangleUrena {
    RectangleSolidAngle rectangle; ///< of the line scaled to an extent of order one
    float inverse_scale;
    float measure, density;
};

/// \param light relative to the shading point [m].
LineRectangleUrena line_rectangle_urena_prepare(const LineSegment light) {
    float scale = scale_of(light);
    LineSegment unit = scaled(light, scale);
    CenteredLine line = centered(unit);
    float distance = sqrt(line.squared);
    vec3 half_width = kNusseltThinness * nusselt_cross(line.closest, unit.s);
    ConvexPolygon polygon = rectangle_polygon(unit.p0 - half_width, line.len * unit.s, 2.0 * half_width,
                                              (1.0 / distance) * line.closest);
    LineRectangleUrena self;
    self.rectangle = rectangle_solid_angle_prepare(polygon);
    self.inverse_scale = reciprocal_power_of_two(scale);
    float radius = kNusseltThinness * distance;
    float measure = rectangle_solid_angle_measure(self.rectangle) / radius * scale;
    bool lit = measure > kNusseltSmallestNormal && measure < 1.0 / kNusseltSmallestNormal;
    self.measure = lit ? measure : 0.0;
    self.density = lit ? self.rectangle.inverse_total * radius * self.inverse_scale : 0.0;
    return self;
}

/// Solid angle per radius [sr/m].
float line_rectangle_urena_measure(const LineRectangleUrena self) { return self.measure; }

/// Constant on the light; the caller knows that wi hits it.
float line_rectangle_urena_pdf(const LineRectangleUrena self, vec3 wi) { return self.density; }

/// \param u in [0, 1); increasing u moves from the start of the light to its end.
LightSample line_rectangle_urena_sample(const LineRectangleUrena self, float u) {
    LightSample s = rectangle_solid_angle_sample(self.rectangle, vec2(u, 0.5));
    return LightSample(s.wi, self.density, self.inverse_scale * s.p);
}

/// The random number for which the sample is wi, a unit direction on the light.
float line_rectangle_urena_invert(const LineRectangleUrena self, vec3 wi) {
    return rectangle_solid_angle_invert(self.rectangle, wi).x;
}

#endif
