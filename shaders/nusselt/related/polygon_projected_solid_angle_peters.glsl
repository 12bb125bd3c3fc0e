#ifndef NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_PETERS_GLSL
#define NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_PETERS_GLSL
// Follows include/nusselt/related/polygon_projected_solid_angle_peters.h @ 8ec2bc99b59f
/// A plain transcription of a published method, to compare with: accuracy and cost of the formulas as printed.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672: Sec. 3
/// with the Kahan products and the sorting networks of Sec. 3.7. Use polygon_projected_solid_angle.glsl instead: this
/// one loses small lights to the difference of two arctangents, and its iteration diverges at some corners on the
/// horizon. Twin of include/nusselt/related/polygon_projected_solid_angle_peters.h.
///
/// Measure and space as polygon_projected_solid_angle.glsl.

#include "../core/light_sample.glsl"
#include "../geometry/convex_polygon.glsl"
#include "../related/bitonic_network.glsl"
#include "../related/peters_arithmetic.glsl"

/// The region between two ellipses, or between the zenith and the outer one, within an azimuth range.
struct PetersSector {
    vec2 s0, s1; ///< directions to both ends
    vec2 outer, inner;
    float area;
};

struct PolygonProjectedSolidAnglePeters {
    vec3 plane_normal;
    float plane_distance;
    float mirror;
    bool central;
    float total;
    PetersSector sector[kNusseltSlots]; ///< without area where there is none
};

/// A vertex and the ellipse of the edge that begins there when going counterclockwise.
struct PetersEvent {
    vec2 s;
    vec2 ellipse;
    float kind; ///< 1: of an outer edge, -1: of an inner one, 0: no edge begins
};

/// The ellipse of the plane with normal n.
vec2 peters_ellipse(vec3 n) { return (1.0 / n.z) * n.xy; }

/// (I + u u^T) w.
vec2 peters_times(vec2 u, vec2 w) { return w + dot(u, w) * u; }

float peters_form(vec2 u, vec2 w) { return dot(w, w) + dot(u, w) * dot(u, w); }

float peters_plain_det(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

/// Eq. 1.
float peters_area_of(vec2 u, vec2 s0, vec2 s1) {
    float inverse_root = 1.0 / sqrt(1.0 + dot(u, u));
    return 0.5 * inverse_root * peters_atan2_positive(peters_plain_det(s0, s1), inverse_root * dot(s0, peters_times(u, s1)));
}

/// Eq. 6 for the form with the matrix [[a, b], [b, c]].
vec2 peters_root(float a, float b, float c) {
    float r = sqrt(nusselt_max(b * b - a * c, 0.0));
    return b >= 0.0 ? vec2(b + r, -a) : vec2(c, r - b);
}

/// Sorts two events by azimuth.
void peters_compare_and_swap(inout PetersEvent a, inout PetersEvent b) {
    if (peters_det(a.s, b.s) < 0.0) {
        PetersEvent c = a;
        a = b;
        b = c;
    }
}

/// The point where an edge meets the horizon.
vec3 peters_crossing(vec3 a, vec3 b) {
    float t = a.z / (a.z - b.z);
    return vec3(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0.0);
}

/// The mirrored vertices above the horizon; spare slots repeat vertices.
void peters_clip(ConvexPolygon light, float mirror, out vec3 v[kNusseltSlots]) {
    // The last slot of a light is spare.
    const int kVertices = kNusseltSlots - 1;
    bool above[kNusseltSlots];
    bool all_above = true;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        v[j] = vec3(light.vertex[j].x, mirror * light.vertex[j].y, light.vertex[j].z);
        above[j] = v[j].z > 0.0;
        all_above = all_above && above[j];
    }
    if (all_above) return;
    // Each lower vertex becomes the point where the boundary comes up again; the point where it goes down is inserted
    // before the first of them.
    vec3 vertex[kNusseltSlots] = v;
    vec3 down = vec3(0.0);
    vec3 up = vec3(0.0);
    NUSSELT_UNROLL for (int j = 0; j < kVertices; ++j) {
        int next = j + 1 < kVertices ? j + 1 : 0;
        if (above[j] != above[next]) {
            vec3 point = peters_crossing(vertex[j], vertex[next]);
            if (above[j])
                down = point;
            else
                up = point;
        }
    }
    bool inserted = false;
    NUSSELT_UNROLL for (int k = 0; k < kVertices; ++k) {
        int before = k > 0 ? k - 1 : 0;
        bool insert = above[k > 0 ? k - 1 : kVertices - 1] && !above[k];
        vec3 kept = above[k] ? vertex[k] : up;
        vec3 shifted = above[before] ? vertex[before] : up;
        v[k] = insert ? down : (inserted ? shifted : kept);
        inserted = inserted || insert;
    }
    v[kVertices] = above[kVertices - 1] ? vertex[kVertices - 1] : up;
}

/// Sec. 3.7.
void polygon_projected_solid_angle_peters_prepare_decentral(inout PolygonProjectedSolidAnglePeters self,
                                                            vec3 vertex[kNusseltSlots], vec3 normal[kNusseltSlots]) {
    PetersEvent event[kNusseltSlots];
    vec2 outer = vec2(0.0);
    vec2 inner = vec2(0.0);
    bool outer_begun = false;
    bool inner_begun = false;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        vec3 n = normal[j];
        vec3 n_before = normal[j > 0 ? j - 1 : kNusseltSlots - 1];
        bool is_outer = n.z > 0.0;
        bool is_inner = n_before.z < 0.0;
        vec2 ellipse = peters_ellipse(is_outer ? n : n_before);
        event[j] = PetersEvent(vertex[j].xy, ellipse, is_outer ? 1.0 : (is_inner ? -1.0 : 0.0));
        // Both begin at the clockwise end of the polygon.
        if (is_outer && is_inner) {
            inner = peters_ellipse(n_before);
            inner_begun = true;
        }
    }
#define NUSSELT_SORT_EVENTS(low, high) peters_compare_and_swap(event[low], event[high]);
    NUSSELT_SORT_BITONIC(NUSSELT_SORT_EVENTS)
#undef NUSSELT_SORT_EVENTS

    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots - 1; ++k) {
        if (event[k].kind > 0.0) {
            outer = event[k].ellipse;
            outer_begun = true;
        } else if (event[k].kind < 0.0) {
            inner = event[k].ellipse;
            inner_begun = true;
        }
        if (outer_begun && inner_begun) {
            vec2 s0 = event[k].s;
            vec2 s1 = event[k + 1].s;
            float area = peters_area_of(outer, s0, s1) - peters_area_of(inner, s0, s1);
            self.sector[k] = PetersSector(s0, s1, outer, inner, nusselt_max(area, 0.0));
        }
    }
}

/// \param light in shading space, either winding [m].
PolygonProjectedSolidAnglePeters polygon_projected_solid_angle_peters_prepare(ConvexPolygon light) {
    PolygonProjectedSolidAnglePeters self;
    self.plane_normal = light.normal;
    self.plane_distance = dot(light.normal, light.vertex[0]);
    self.mirror = self.plane_distance < 0.0 ? -1.0 : 1.0;
    vec3 vertex[kNusseltSlots];
    vec3 normal[kNusseltSlots];
    peters_clip(light, self.mirror, vertex);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j)
        self.sector[j] = PetersSector(vec2(0.0), vec2(0.0), vec2(0.0), vec2(0.0), 0.0);
    bool has_inner = false;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        normal[j] = peters_cross(vertex[j], vertex[j + 1 < kNusseltSlots ? j + 1 : 0]);
        has_inner = has_inner || normal[j].z < 0.0;
    }
    self.central = !has_inner;
    if (self.central) {
        NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
            if (normal[j].z > 0.0) {
                vec2 s0 = vertex[j].xy;
                vec2 s1 = vertex[j + 1 < kNusseltSlots ? j + 1 : 0].xy;
                vec2 outer = peters_ellipse(normal[j]);
                self.sector[j] = PetersSector(s0, s1, outer, vec2(0.0), peters_area_of(outer, s0, s1));
            }
        }
    } else {
        polygon_projected_solid_angle_peters_prepare_decentral(self, vertex, normal);
    }
    self.total = 0.0;
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k) self.total = self.total + self.sector[k].area;
    return self;
}

/// Projected solid angle of the part of the light above the horizon [sr].
float polygon_projected_solid_angle_peters_measure(PolygonProjectedSolidAnglePeters self) { return self.total; }

/// \param wi a unit direction towards the light.
float polygon_projected_solid_angle_peters_pdf(PolygonProjectedSolidAnglePeters self, vec3 wi) {
    return wi.z / self.total;
}

/// Sec. 3.4 and two steps of Sec. 3.3.
vec2 peters_invert_decentral(PetersSector s, float area) {
    vec2 s0 = (1.0 / sqrt(dot(s.s0, s.s0))) * s.s0;
    vec2 s1 = (1.0 / sqrt(dot(s.s1, s.s1))) * s.s1;
    vec2 sh = s0 + s1;
    float i0 = 1.0 / sqrt(peters_form(s.inner, s0));
    float ih = 1.0 / sqrt(peters_form(s.inner, sh));
    float i1 = 1.0 / sqrt(peters_form(s.inner, s1));
    float o0 = 1.0 / sqrt(peters_form(s.outer, s0));
    float oh = 1.0 / sqrt(peters_form(s.outer, sh));
    float o1 = 1.0 / sqrt(peters_form(s.outer, s1));
    float fraction = nusselt_min(area / s.area, 1.0);
    float quad_0 = o0 * oh - i0 * ih;
    float quad_1 = o1 * oh - i1 * ih;
    float quad_area = fraction * (quad_0 + quad_1) - quad_0;
    bool first = quad_area <= 0.0;
    vec2 sk = first ? s0 : s1;
    float ik = first ? i0 : i1;
    float ok = first ? o0 : o1;
    quad_area = (first ? quad_area + quad_0 : quad_area - quad_1) * abs(peters_plain_det(sh, sk));
    vec2 ri = peters_times(s.inner, ih * sh + ik * sk);
    vec2 ro = peters_times(s.outer, oh * sh + ok * sk);
    vec2 turned = vec2(-sk.y, sk.x);
    vec2 p = (ok * oh * dot(ro, sh)) * turned;
    vec2 q = (ik * ih * dot(ri, sh)) * turned + quad_area * ri;
    vec2 w = peters_root(p.x * ri.x - q.x * ro.x, 0.5 * (p.x * ri.y + p.y * ri.x - q.x * ro.y - q.y * ro.x),
                         p.y * ri.y - q.y * ro.y);
    int iterations = fraction < 1e-5 || fraction > 1.0 - 1e-5 ? 0 : 2;
    for (int k = 0; k <= 2; ++k) {
        if (dot(w, sh) < 0.0) w = -w;
        w = (1.0 / (abs(w.x) + abs(w.y))) * w;
        if (k == iterations) break;
        float missing = 2.0 * (area - peters_area_of(s.outer, s0, w) + peters_area_of(s.inner, s0, w));
        vec2 ci = peters_times(s.inner, w);
        vec2 co = peters_times(s.outer, w);
        vec2 gap = ci - co;
        w = peters_root(-w.y * gap.x - missing * ci.x * co.x,
                        0.5 * (-w.y * gap.y + w.x * gap.x - missing * (ci.x * co.y + ci.y * co.x)),
                        w.x * gap.y - missing * ci.y * co.y);
    }
    return w;
}

/// \param u in [0, 1)^2.
/// \returns the direction alone, as the paper does; polygon_projected_solid_angle_peters_sample() adds density and point.
vec3 polygon_projected_solid_angle_peters_direction(PolygonProjectedSolidAnglePeters self, vec2 u) {
    float area = u.x * self.total;
    PetersSector s = self.sector[0];
    NUSSELT_UNROLL for (int k = 1; k < kNusseltSlots; ++k) {
        if (self.sector[k].area > 0.0 && area >= s.area) {
            area = area - s.area;
            s = self.sector[k];
        }
    }
    vec2 w;
    if (self.central) {
        float root = sqrt(1.0 + dot(s.outer, s.outer));
        vec2 c = peters_times(s.outer, s.s0);
        SinCos angle = peters_sincos_half_turn(2.0 * root * area);
        w = (root * angle.cosine) * s.s0 + angle.sine * vec2(-c.y, c.x);
        w = sqrt(u.y / peters_form(s.outer, w)) * w;
    } else {
        w = peters_invert_decentral(s, area);
        w = sqrt((1.0 - u.y) / peters_form(s.inner, w) + u.y / peters_form(s.outer, w)) * w;
    }
    return vec3(w.x, self.mirror * w.y, sqrt(nusselt_max(1.0 - dot(w, w), 0.0)));
}

/// \param u in [0, 1)^2.
LightSample polygon_projected_solid_angle_peters_sample(PolygonProjectedSolidAnglePeters self, vec2 u) {
    vec3 wi = polygon_projected_solid_angle_peters_direction(self, u);
    return LightSample(wi, wi.z / self.total, (self.plane_distance / dot(self.plane_normal, wi)) * wi);
}

#endif
