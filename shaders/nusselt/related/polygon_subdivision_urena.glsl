#ifndef NUSSELT_RELATED_POLYGON_SUBDIVISION_URENA_GLSL
#define NUSSELT_RELATED_POLYGON_SUBDIVISION_URENA_GLSL
// Follows include/nusselt/related/polygon_subdivision_urena.h @ 5bf4d83d79e7
/// A published method, to compare with: sampling of triangles almost in proportion to the cosine by recursive subdivision.
/// C. Ureña 2000, Computation of Irradiance from Triangles by Adaptive Sampling, CGF 19(2), doi:10.1111/1467-8659.00452. Use
/// polygon_projected_solid_angle.glsl instead. Twin of include/nusselt/related/polygon_subdivision_urena.h, which lists
/// deviations and known failures.
///
/// Measure and space as polygon_projected_solid_angle.glsl; the density is that of the subdivision.

#include "../core/light_sample.glsl"
#include "../related/clip_vertices.glsl"
#include "../related/spherical_triangle_arvo.glsl"

const int kNusseltSubdivisions = 4;

struct PolygonSubdivisionUrena {
    vec3 plane_normal;
    float plane_distance;
    float side;                       ///< sign of the triple product of three vertices
    vec3 v[kNusseltSlots];            ///< unit directions to the vertices above the horizon
    float spoke[kNusseltSlots - 1];   ///< terms of Lambert's formula for arcs from vertex 0
    float edge[kNusseltSlots - 2];    ///< and for edges of the light
    float measure[kNusseltSlots - 2]; ///< projected solid angles of the triangles of the fan
    float total;
    float inverse_total; ///< 0 without light
};

/// A triangle with the terms of Lambert's formula for its arcs; their sum is its projected solid angle.
struct UrenaNode {
    vec3 a, b, c;
    float ab, bc, ca;
};

/// The four parts of a triangle: their projected solid angles, the terms of the arcs between them, with the sign for the
/// corners, and the middles of its arcs.
struct UrenaSplit {
    vec3 ab, bc, ca;
    float at_a, at_b, at_c;
    float corner_a, corner_b, corner_c, center;
};

/// The part of the unit interval that belongs to a triangle.
struct UrenaInterval {
    float begin, extent;
};

vec3 urena_unit(vec3 v) { return (1.0 / sqrt(dot(v, v))) * v; }

/// a / b, or 0 where b is 0.
float urena_over(float a, float b) { return b > 0.0 ? a / b : 0.0; }

/// The term of an arc in Lambert's formula.
/// \param side sign for the winding.
float urena_lambert(vec3 a, vec3 b, float side) {
    vec3 n = peters_cross(a, b);
    float sine = sqrt(dot(n, n));
    return urena_over(0.5 * side * n.z * peters_atan2_positive(sine, dot(a, b)), sine);
}

UrenaNode urena_fan_triangle(PolygonSubdivisionUrena self, int j) {
    return UrenaNode(self.v[0], self.v[j + 1], self.v[j + 2], self.spoke[j], self.edge[j], -self.spoke[j + 1]);
}

/// Whether a direction is on the side of an arc on which the light is if the arc runs along its outline.
bool urena_is_left_of(vec3 begin, vec3 end, vec3 wi, float side) {
    return side * dot(peters_cross(begin, end), wi) > 0.0;
}

/// \param light in shading space, either winding [m].
PolygonSubdivisionUrena polygon_subdivision_urena_prepare(const ConvexPolygon light) {
    PolygonSubdivisionUrena self;
    self.plane_normal = light.normal;
    self.plane_distance = dot(light.normal, light.vertex[0]);
    self.side = self.plane_distance < 0.0 ? -1.0 : 1.0;
    peters_clip(light, 1.0, self.v);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) self.v[j] = urena_unit(self.v[j]);
    // Find the terms of Lambert's formula for all arcs of the fan, so that those of each triangle sum up to its projected
    // solid angle.
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 1; ++j)
        self.spoke[j] = urena_lambert(self.v[0], self.v[j + 1], self.side);
    self.total = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots - 2; ++j) {
        self.edge[j] = urena_lambert(self.v[j + 1], self.v[j + 2], self.side);
        self.measure[j] = nusselt_max(self.spoke[j] + self.edge[j] - self.spoke[j + 1], 0.0);
        self.total = self.total + self.measure[j];
    }
    self.inverse_total = self.total > 0.0 ? 1.0 / self.total : 0.0;
    return self;
}

/// Projected solid angle of the part of the light above the horizon [sr].
float polygon_subdivision_urena_measure(const PolygonSubdivisionUrena self) { return self.total; }

UrenaSplit urena_split(const UrenaNode node, float side) {
    UrenaSplit s;
    s.ab = urena_unit(node.a + node.b);
    s.bc = urena_unit(node.b + node.c);
    s.ca = urena_unit(node.c + node.a);
    s.at_a = urena_lambert(s.ab, s.ca, side);
    s.at_b = urena_lambert(s.bc, s.ab, side);
    s.at_c = urena_lambert(s.ca, s.bc, side);
    // Rounding can make them negative. The probabilities are relative to what is left of all four.
    s.corner_a = nusselt_max(0.5 * node.ab + s.at_a + 0.5 * node.ca, 0.0);
    s.corner_b = nusselt_max(0.5 * node.ab + 0.5 * node.bc + s.at_b, 0.0);
    s.corner_c = nusselt_max(0.5 * node.bc + 0.5 * node.ca + s.at_c, 0.0);
    s.center = nusselt_max(-(s.at_a + s.at_b + s.at_c), 0.0);
    return s;
}

/// Goes down to corner a or the center, or to the right to corner b or c; the center and c are the upper ones.
/// \param probability in: of the node; out: of the child.
UrenaNode urena_child(const UrenaNode node, const UrenaSplit s, bool right, bool upper, inout float probability) {
    float chosen = right ? (upper ? s.corner_c : s.corner_b) : (upper ? s.center : s.corner_a);
    probability = probability * urena_over(chosen, (s.corner_a + s.center) + (s.corner_b + s.corner_c));
    if (right && upper) return UrenaNode(s.ca, s.bc, node.c, s.at_c, 0.5 * node.bc, 0.5 * node.ca);
    if (right) return UrenaNode(s.ab, node.b, s.bc, 0.5 * node.ab, 0.5 * node.bc, s.at_b);
    if (upper) return UrenaNode(s.bc, s.ca, s.ab, -s.at_c, -s.at_a, -s.at_b);
    return UrenaNode(node.a, s.ab, s.ca, 0.5 * node.ab, s.at_a, 0.5 * node.ca);
}

/// Chooses one of two weights by a random number, which becomes what is left of it.
/// \returns whether it is the second one.
bool urena_take(inout float u, float first, float second) {
    float target = u * (first + second);
    bool is_second = target >= first && second > 0.0;
    u = below_one(is_second ? urena_over(target - first, second) : urena_over(target, first));
    return is_second;
}

/// \param u in [0, 1)^2.
LightSample polygon_subdivision_urena_sample(PolygonSubdivisionUrena self, vec2 u) {
    // Select a triangle of the fan. What is left of the random number is random again.
    float part = u.x * self.total;
    float measure = self.measure[0];
    UrenaNode node = urena_fan_triangle(self, 0);
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots - 2; ++j) {
        if (self.measure[j] > 0.0 && part >= measure) {
            part = part - measure;
            measure = self.measure[j];
            node = urena_fan_triangle(self, j);
        }
    }
    vec2 left = vec2(below_one(urena_over(part, measure)), u.y);
    float probability = 1.0;
    for (int level = 0; level < kNusseltSubdivisions; ++level) {
        UrenaSplit s = urena_split(node, self.side);
        bool right = urena_take(left.x, s.corner_a + s.center, s.corner_b + s.corner_c);
        bool upper = urena_take(left.y, right ? s.corner_b : s.corner_a, right ? s.corner_c : s.center);
        node = urena_child(node, s, right, upper, probability);
    }
    SphericalTriangleArvo leaf = make_spherical_triangle_arvo(node.a, node.b, node.c);
    vec3 wi = vec3(0.0, 0.0, 1.0);
    if (self.inverse_total > 0.0) wi = spherical_triangle_arvo_direction(leaf, left.x * leaf.solid_angle, left.y);
    return LightSample(wi, urena_over(measure * self.inverse_total * probability, leaf.solid_angle),
                       (self.plane_distance / dot(self.plane_normal, wi)) * wi);
}

/// \param second, is_second as in urena_take().
void urena_narrow(inout UrenaInterval interval, float first, float second, bool is_second) {
    float share = urena_over(first, first + second);
    if (is_second) interval.begin = interval.begin + interval.extent * share;
    interval.extent = interval.extent * (is_second ? 1.0 - share : share);
}

/// The random numbers for a direction on the light, and its density.
vec3 urena_locate(PolygonSubdivisionUrena self, vec3 wi) {
    // The last triangle of the fan whose first spoke wi is behind.
    UrenaNode node = urena_fan_triangle(self, 0);
    float measure = self.measure[0];
    float before = 0.0;
    UrenaInterval x = UrenaInterval(0.0, 0.0);
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots - 2; ++j) {
        before = before + self.measure[j - 1];
        if (self.measure[j] > 0.0 && (measure <= 0.0 || urena_is_left_of(self.v[0], self.v[j + 1], wi, self.side))) {
            node = urena_fan_triangle(self, j);
            x.begin = before * self.inverse_total;
            measure = self.measure[j];
        }
    }
    x.extent = measure * self.inverse_total;
    UrenaInterval y = UrenaInterval(0.0, 1.0);
    float probability = 1.0;
    for (int level = 0; level < kNusseltSubdivisions; ++level) {
        UrenaSplit s = urena_split(node, self.side);
        bool at_a = urena_is_left_of(s.ab, s.ca, wi, self.side);
        bool at_b = urena_is_left_of(s.bc, s.ab, wi, self.side);
        bool at_c = urena_is_left_of(s.ca, s.bc, wi, self.side);
        bool right = at_b || at_c;
        bool upper = at_c || !(at_a || at_b);
        urena_narrow(x, s.corner_a + s.center, s.corner_b + s.corner_c, right);
        urena_narrow(y, right ? s.corner_b : s.corner_a, right ? s.corner_c : s.center, upper);
        node = urena_child(node, s, right, upper, probability);
    }
    SphericalTriangleArvo leaf = make_spherical_triangle_arvo(node.a, node.b, node.c);
    PlaceInTriangle place = spherical_triangle_arvo_place_of(leaf, wi, self.side);
    float share = below_one(urena_over(place.part, leaf.solid_angle));
    return vec3(below_one(x.begin + x.extent * share), below_one(y.begin + y.extent * below_one(place.u)),
                urena_over(measure * self.inverse_total * probability, leaf.solid_angle));
}

/// \param wi a unit direction on the light.
float polygon_subdivision_urena_pdf(const PolygonSubdivisionUrena self, vec3 wi) { return urena_locate(self, wi).z; }

/// The random numbers for which polygon_subdivision_urena_sample() returns wi, a unit direction on the light.
vec2 polygon_subdivision_urena_invert(const PolygonSubdivisionUrena self, vec3 wi) { return urena_locate(self, wi).xy; }

#endif
