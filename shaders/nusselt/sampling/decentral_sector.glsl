#ifndef NUSSELT_SAMPLING_DECENTRAL_SECTOR_GLSL
#define NUSSELT_SAMPLING_DECENTRAL_SECTOR_GLSL
// Follows include/nusselt/sampling/decentral_sector.h @ 8a63403667b0
/// Area between two projected great circles and its inversion: the azimuth of a sample when the zenith lies outside of
/// the polygon (Peters 2021, polygonal lights, Sec. 3.1 and 3.3 to 3.6). Twin of
/// include/nusselt/sampling/decentral_sector.h.

#include "../core/trig.glsl"
#include "../core/vec.glsl"

/// Steps of the iteration.
const int kNusseltPolygonIterations = 2;

/// The region of the tangent plane between an outer and an inner great circle, projected, within an azimuth range.
/// Points of the range are x in [0, 1] on a chord of the outer circle's plane.
struct DecentralSector {
    vec3 begin;             ///< a point in the plane of the outer circle, at the start of the range
    vec3 chord;             ///< from there to the end of the range, counterclockwise around the zenith
    float begin_gap;        ///< height of the plane of the inner circle above the chord at its start, >= 0
    float end_gap;          ///< the same at its end
    float doubled_triangle; ///< det(begin, chord) in the tangent plane, > 0
};

/// The quadratic forms of both ellipses at a point of the chord, that is, squared distances from the origin.
struct DecentralForms {
    vec3 outer_point;
    float gap;   ///< height of the inner circle's plane above the chord
    float outer; ///< form of the outer ellipse
    float rise;  ///< form of the inner ellipse minus that, >= 0
};

DecentralForms decentral_sector_at(const DecentralSector self, float x) {
    vec3 outer_point = self.begin + x * self.chord;
    float gap = nusselt_fma(x, self.end_gap - self.begin_gap, self.begin_gap);
    return DecentralForms(outer_point, gap, dot(outer_point, outer_point),
                          nusselt_max(gap * nusselt_fma(2.0, outer_point.z, gap), 0.0));
}

/// The arcs of both ellipses between the start of a sector and x. Sines and cosines of the angles about the origin are
/// not normalised.
struct DecentralArcs {
    float doubled_triangle; ///< det(begin, end) in the tangent plane
    float outer_cosine;
    float rise; ///< inner cosine minus the outer one
    float inner_cosine;
    float outer_sine2, inner_sine2; ///< squares
    float sine2_step;               ///< inner square minus the outer one, accurate relative to itself
};

/// What all areas of a sector need: properties of the planes through the origin and both circles. Their normals are those
/// of the segments from the start to x, divided by x.
struct DecentralPlanes {
    float outer_squared, inner_squared; ///< squared lengths of the normals
    float squared_step;                 ///< their difference
};

DecentralPlanes decentral_sector_planes(const DecentralSector self) {
    vec3 begin = self.begin;
    vec3 chord = self.chord;
    float turn = self.end_gap - self.begin_gap;
    vec3 outer_normal = nusselt_cross(begin, chord);
    vec2 lift = vec2(nusselt_fma(turn, begin.y, -self.begin_gap * chord.y),
                     nusselt_fma(self.begin_gap, chord.x, -turn * begin.x));
    vec3 inner_normal = vec3(outer_normal.xy + lift, outer_normal.z);
    return DecentralPlanes(dot(outer_normal, outer_normal), dot(inner_normal, inner_normal),
                           dot(lift, outer_normal.xy + inner_normal.xy));
}

DecentralArcs decentral_sector_arcs_to(const DecentralSector self, const DecentralPlanes planes, float x) {
    float outer_cosine = dot(self.begin, self.begin + x * self.chord);
    float gap = nusselt_fma(x, self.end_gap - self.begin_gap, self.begin_gap);
    float rise = nusselt_fma(self.begin_gap, nusselt_fma(x, self.chord.z, self.begin.z) + gap, self.begin.z * gap);
    float x2 = x * x;
    return DecentralArcs(x * self.doubled_triangle, outer_cosine, rise, outer_cosine + rise,
                         x2 * planes.outer_squared, x2 * planes.inner_squared, x2 * planes.squared_step);
}

/// Whether both angles are at most an eighth of a turn.
bool decentral_arcs_are_narrow(const DecentralArcs arcs) {
    return arcs.outer_cosine > 0.0 && arcs.outer_sine2 <= arcs.outer_cosine * arcs.outer_cosine &&
           arcs.inner_sine2 <= arcs.inner_cosine * arcs.inner_cosine;
}

/// Twice the area between narrow arcs: angle / sine = (1 - k) / cosine with k of the order of the squared angle.
float decentral_narrow_doubled_area(const DecentralArcs arcs) {
    float inverse_product = 1.0 / (arcs.outer_cosine * arcs.inner_cosine);
    float outer_inverse = inverse_product * arcs.inner_cosine;
    float inner_inverse = inverse_product * arcs.outer_cosine;
    float outer_tangent2 = arcs.outer_sine2 * outer_inverse * outer_inverse;
    float tangent2_step = nusselt_fma(arcs.sine2_step, arcs.outer_cosine * arcs.outer_cosine,
                                      -arcs.outer_sine2 * arcs.rise * (arcs.outer_cosine + arcs.inner_cosine)) *
                          inverse_product * inverse_product;
    AtanRatioDifference k = one_minus_atan_ratio_difference(nusselt_min(outer_tangent2, 1.0), tangent2_step);
    float difference = nusselt_fma(arcs.rise * inverse_product, 1.0 - k.value, inner_inverse * k.difference);
    return nusselt_max(arcs.doubled_triangle * difference, 0.0);
}

/// Arcs of which arctangents are needed.
struct DecentralWideArcs {
    float doubled_triangle;
    float outer_sine, inner_sine, inner_cosine;
    float more; ///< inner sine minus the outer one
    float step_sine, step_cosine; ///< of the inner angle minus the outer one
};

DecentralWideArcs decentral_wide_arcs(const DecentralArcs arcs) {
    float outer_sine = sqrt(arcs.outer_sine2);
    float inner_sine = sqrt(arcs.inner_sine2);
    float sum = inner_sine + outer_sine;
    float more = arcs.sine2_step / (sum > 0.0 ? sum : 1.0);
    return DecentralWideArcs(arcs.doubled_triangle, outer_sine, inner_sine, arcs.inner_cosine, more,
                             nusselt_fma(outer_sine, arcs.rise, -more * arcs.outer_cosine),
                             nusselt_fma(arcs.outer_cosine, arcs.inner_cosine, outer_sine * inner_sine));
}

/// Twice the area between wide arcs.
/// \param inner_angle of the inner arc.
/// \param step_angle  inner angle minus the outer one, without its sign.
float decentral_wide_doubled_area(const DecentralWideArcs arcs, float inner_angle, float step_angle) {
    if (!(arcs.outer_sine > 0.0 && arcs.inner_sine > 0.0)) return 0.0;
    float difference = nusselt_fma(copysign(step_angle, arcs.step_sine), arcs.inner_sine, inner_angle * arcs.more) /
                       (arcs.outer_sine * arcs.inner_sine);
    return nusselt_max(arcs.doubled_triangle * difference, 0.0);
}

/// Twice the area from the start to x (Prop. 1 for both ellipses). Each ellipse contributes the determinant of its end
/// points times angle / sine; the determinants are equal.
float decentral_sector_doubled_area_to(const DecentralSector self, const DecentralPlanes planes, float x) {
    DecentralArcs arcs = decentral_sector_arcs_to(self, planes, x);
    if (decentral_arcs_are_narrow(arcs)) return decentral_narrow_doubled_area(arcs);
    DecentralWideArcs wide = decentral_wide_arcs(arcs);
    return decentral_wide_doubled_area(wide, atan2_positive(wide.inner_sine, wide.inner_cosine),
                                       atan2_positive(abs(wide.step_sine), wide.step_cosine));
}

/// The same with atan2_positive_fast().
float decentral_sector_fast_doubled_area_to(const DecentralSector self, const DecentralPlanes planes, float x) {
    DecentralArcs arcs = decentral_sector_arcs_to(self, planes, x);
    if (decentral_arcs_are_narrow(arcs)) return decentral_narrow_doubled_area(arcs);
    DecentralWideArcs wide = decentral_wide_arcs(arcs);
    return decentral_wide_doubled_area(wide, atan2_positive_fast(wide.inner_sine, wide.inner_cosine),
                                       atan2_positive_fast(abs(wide.step_sine), wide.step_cosine));
}

/// The root of a x^2 + 2 b x + c = 0 that goes to 0 with c while b > 0, continued (Blinn 2006; Peters 2021, Eq. 6). A
/// negative discriminant counts as 0.
float root_near_zero(float a, float b, float c) {
    float root = sqrt(nusselt_max(nusselt_fma(b, b, -a * c), 0.0));
    float numerator = b >= 0.0 ? -c : root - b;
    float denominator = b >= 0.0 ? b + root : a;
    return numerator / (denominator != 0.0 ? denominator : 1.0);
}

/// Samples two quads that approximate the sector (Sec. 3.4): each lies between the chords of both ellipses from one
/// end of the range to its middle.
/// \param fraction of the area that shall lie before the result.
float decentral_sector_initial_position(const DecentralSector self, float fraction) {
    // The direction to the middle is the sum of the unit directions to both ends.
    vec3 end = self.begin + self.chord;
    float r0 = sqrt(nusselt_fma(self.begin.x, self.begin.x, self.begin.y * self.begin.y));
    float r1 = sqrt(nusselt_fma(end.x, end.x, end.y * end.y));
    float radii = r0 + r1;
    float middle = r0 / (radii > 0.0 ? radii : 1.0);
    DecentralForms f0 = decentral_sector_at(self, 0.0);
    DecentralForms fh = decentral_sector_at(self, middle);
    DecentralForms f1 = decentral_sector_at(self, 1.0);

    // Roots of products of forms at both ends of each chord, and what the inner one has more.
    float inner_h = fh.outer + fh.rise;
    float outer_0 = sqrt(f0.outer * fh.outer);
    float outer_1 = sqrt(f1.outer * fh.outer);
    float inner_0 = sqrt((f0.outer + f0.rise) * inner_h);
    float inner_1 = sqrt((f1.outer + f1.rise) * inner_h);
    float squares_0 = nusselt_fma(f0.rise, inner_h, f0.outer * fh.rise);
    float squares_1 = nusselt_fma(f1.rise, inner_h, f1.outer * fh.rise);
    float quad_0 = middle * squares_0 / (outer_0 * inner_0 * (inner_0 + outer_0));
    float quad_1 = (1.0 - middle) * squares_1 / (outer_1 * inner_1 * (inner_1 + outer_1));
    float rest = nusselt_fma(fraction, quad_1, nusselt_fma(fraction, quad_0, -quad_0));
    bool first = rest <= 0.0;

    // With v in [0, 1] from the end to the middle, the areas below the chords of the ellipses up to v are
    // v / (form (1 - v) + root v); their difference is a quadratic in v.
    float outer_form = first ? f0.outer : f1.outer;
    float rise = first ? f0.rise : f1.rise;
    float width = first ? middle : 1.0 - middle;
    float target = nusselt_max(first ? rest + quad_0 : quad_1 - rest, 0.0) / (width > 0.0 ? width : 1.0);
    float outer_root = first ? outer_0 : outer_1;
    float inner_root = first ? inner_0 : inner_1;
    float outer_slope = outer_root - outer_form;
    float inner_form = outer_form + rise;
    float inner_slope = inner_root - inner_form;
    float more = (first ? squares_0 : squares_1) / (inner_root + outer_root);
    float a = more - rise - target * outer_slope * inner_slope;
    float b = 0.5 * (rise - target * nusselt_fma(outer_form, inner_slope, outer_slope * inner_form));
    float v = nusselt_min(nusselt_max(root_near_zero(a, b, -target * outer_form * inner_form), 0.0), 1.0);
    return first ? v * width : 1.0 - v * width;
}

/// One step of the iteration (Sec. 3.3): replaces both ellipses by their tangents at x. The error is cubed.
/// \param missing twice the area that shall lie between x and the result.
float decentral_sector_step(const DecentralSector self, float x, float missing) {
    DecentralForms f = decentral_sector_at(self, x);
    float turn = self.end_gap - self.begin_gap;
    float inner = f.outer + f.rise;
    float outer_slope = dot(f.outer_point, self.chord);
    float rise_slope = nusselt_fma(f.gap, self.chord.z, (f.outer_point.z + f.gap) * turn);
    float inner_slope = outer_slope + rise_slope;
    float a = nusselt_fma(self.doubled_triangle, rise_slope, -missing * outer_slope * inner_slope);
    float b = 0.5 * nusselt_fma(self.doubled_triangle, f.rise,
                                -missing * nusselt_fma(f.outer, inner_slope, inner * outer_slope));
    return nusselt_min(nusselt_max(x + root_near_zero(a, b, -missing * f.outer * inner), 0.0), 1.0);
}

/// The position before which the given area lies.
/// \param target        twice that area, in [0, doubled_total].
/// \param doubled_total twice the area of the sector, > 0.
float decentral_sector_position(const DecentralSector self, float target, float doubled_total) {
    float fraction = target / (doubled_total > 0.0 ? doubled_total : 1.0);
    float x = decentral_sector_initial_position(self, nusselt_min(fraction, 1.0));
    // Rounding of the areas; nothing is gained below.
    float tolerance = (4.0 * kNusseltEpsilon) * doubled_total;
    DecentralPlanes planes = decentral_sector_planes(self);
    for (int i = 0; i < kNusseltPolygonIterations; ++i) {
        float missing = target - decentral_sector_doubled_area_to(self, planes, x);
        if (!(abs(missing) > tolerance)) break;
        x = decentral_sector_step(self, x, missing);
    }
    return x;
}

/// The azimuth of a vertex, which belongs to the outer or the inner edges of a polygon, on an edge of the others.
struct AzimuthOnEdge {
    vec2 vertex; ///< its projection to the tangent plane
    vec3 edge;   ///< from its start to its end, counterclockwise around the zenith
    vec3 step;   ///< from that start to the vertex
    float way;   ///< determinant of the start with the step in the tangent plane, positive: counterclockwise
    float slope; ///< determinant of the vertex with the edge; the share of the edge up to the azimuth is way / slope
};

/// Height of the plane of the inner circle above the outer point at this azimuth, by determinants: the difference of both
/// points cancels where the chains are close to each other.
/// \param normal, distance of the plane of the polygon.
/// \param divisor if the vertex belongs to the outer edges, minus the determinant of start and end of the edge in the
///                 tangent plane; else the slope.
float azimuth_on_edge_gap(const AzimuthOnEdge self, vec3 normal, float distance, float divisor) {
    float upright = (normal.z * normal.z) * dot(self.vertex, self.vertex);
    float level = dot(normal.xy, self.vertex);
    bool is_flat = upright >= level * level;
    float outward = is_flat ? det(self.edge.xy, self.step.xy)
                            : difference_of_products(self.step.z, self.slope, self.way, self.edge.z);
    float extent = (is_flat ? normal.z : level) * divisor;
    return nusselt_max(distance * outward / (extent != 0.0 ? extent : 1.0), 0.0);
}

#endif
