#ifndef NUSSELT_RELATED_AZIMUTH_SECTORS_GLSL
#define NUSSELT_RELATED_AZIMUTH_SECTORS_GLSL
// Follows include/nusselt/related/azimuth_sectors.h @ 29d88183466c
/// Polygons cut into sectors of azimuths, for published methods that first choose an azimuth and then an inclination:
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672, Sec. 3,
/// with the Kahan products and the sorting networks of Sec. 3.7. Twin of include/nusselt/related/azimuth_sectors.h, which
/// walks along both chains of edges for scalars.

#include "../core/light_sample.glsl"
#include "../geometry/convex_polygon.glsl"
#include "../related/bitonic_network.glsl"
#include "../related/clip_vertices.glsl"
#include "../related/peters_arithmetic.glsl"

/// The region between two ellipses, or between the zenith and the outer one, within an azimuth range.
struct AzimuthSector {
    vec2 s0, s1; ///< directions to both ends
    vec2 outer, inner;
    float area;
};

struct AzimuthSectors {
    vec3 plane_normal;
    float plane_distance;
    float mirror; ///< -1 where y is mirrored, so that the winding is the one that the method wants
    bool central; ///< whether sectors begin at the zenith instead of at an inner ellipse
    float total;
    float inverse_total;                 ///< 0 without light
    AzimuthSector sector[kNusseltSlots]; ///< without area where there is none
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

/// One on the ellipse of u.
float peters_form(vec2 u, vec2 w) { return dot(w, w) + dot(u, w) * dot(u, w); }

float peters_plain_det(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

/// The area of the ellipse of u between two azimuths (Eq. 1).
float peters_area_of(vec2 u, vec2 s0, vec2 s1) {
    float inverse_root = 1.0 / sqrt(1.0 + dot(u, u));
    return 0.5 * inverse_root * peters_atan2_positive(peters_plain_det(s0, s1), inverse_root * dot(s0, peters_times(u, s1)));
}

/// The area of a sector up to the azimuth of w.
/// \param central whether the sector begins at the zenith instead of the inner ellipse.
float azimuth_sector_area_to(const AzimuthSector self, vec2 w, bool central) {
    float to_outer = peters_area_of(self.outer, self.s0, w);
    return central ? to_outer : to_outer - peters_area_of(self.inner, self.s0, w);
}

/// Sorts two events by azimuth.
void peters_compare_and_swap(inout PetersEvent a, inout PetersEvent b) {
    if (peters_det(a.s, b.s) < 0.0) {
        PetersEvent c = a;
        a = b;
        b = c;
    }
}

/// Sec. 3.7.
void azimuth_sectors_prepare_decentral(inout AzimuthSectors self, vec3 vertex[kNusseltSlots],
                                       vec3 normal[kNusseltSlots]) {
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
            self.sector[k] = AzimuthSector(s0, s1, outer, inner, nusselt_max(area, 0.0));
        }
    }
}

/// \param light in shading space, either winding [m].
AzimuthSectors azimuth_sectors_prepare(const ConvexPolygon light) {
    AzimuthSectors self;
    self.plane_normal = light.normal;
    self.plane_distance = dot(light.normal, light.vertex[0]);
    self.mirror = self.plane_distance < 0.0 ? -1.0 : 1.0;
    vec3 vertex[kNusseltSlots];
    vec3 normal[kNusseltSlots];
    peters_clip(light, self.mirror, vertex);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j)
        self.sector[j] = AzimuthSector(vec2(0.0), vec2(0.0), vec2(0.0), vec2(0.0), 0.0);
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
                self.sector[j] = AzimuthSector(s0, s1, outer, vec2(0.0), peters_area_of(outer, s0, s1));
            }
        }
    } else {
        azimuth_sectors_prepare_decentral(self, vertex, normal);
    }
    self.total = 0.0;
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k) self.total = self.total + self.sector[k].area;
    self.inverse_total = self.total > 0.0 ? 1.0 / self.total : 0.0;
    return self;
}

/// \param area in: to be found, out: the part in the sector.
AzimuthSector azimuth_sectors_select(AzimuthSectors self, inout float area) {
    AzimuthSector s = self.sector[0];
    NUSSELT_UNROLL for (int k = 1; k < kNusseltSlots; ++k) {
        if (self.sector[k].area > 0.0 && area >= s.area) {
            area = area - s.area;
            s = self.sector[k];
        }
    }
    return s;
}

/// The direction at an azimuth within a sector.
/// \param w towards the azimuth, of any length.
/// \param u in [0, 1), uniform in area between both ellipses.
vec3 azimuth_sectors_direction(const AzimuthSectors self, const AzimuthSector s, vec2 w, float u) {
    float squared = u / peters_form(s.outer, w);
    if (!self.central) squared = squared + (1.0 - u) / peters_form(s.inner, w);
    vec2 scaled = sqrt(squared) * w;
    return vec3(scaled.x, self.mirror * scaled.y, sqrt(nusselt_max(1.0 - dot(scaled, scaled), 0.0)));
}

/// Adds density and point to a direction on the light. Without light, the density is 0.
LightSample azimuth_sectors_complete(const AzimuthSectors self, vec3 direction) {
    vec3 wi = self.inverse_total > 0.0 ? direction : vec3(0.0, 0.0, 1.0);
    return LightSample(wi, wi.z * self.inverse_total, (self.plane_distance / dot(self.plane_normal, wi)) * wi);
}

/// Projected solid angle of the part of the light above the horizon [sr].
float azimuth_sectors_measure(const AzimuthSectors self) { return self.total; }

/// \param wi a unit direction towards the light.
float azimuth_sectors_pdf(const AzimuthSectors self, vec3 wi) { return nusselt_max(wi.z, 0.0) * self.inverse_total; }

/// The random numbers for wi, a unit direction on the light: its share of the area in order of azimuths, and the share of
/// the area between both ellipses in the direction of the azimuth. At the zenith, both are 0.
vec2 azimuth_sectors_invert(AzimuthSectors self, vec3 wi) {
    vec2 w = vec2(wi.x, self.mirror * wi.y);
    bool found = !(self.inverse_total > 0.0);
    float before = 0.0;
    float area = 0.0;
    float height = 0.0;
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k) {
        AzimuthSector s = self.sector[k];
        // In the decentral case, the order of sectors tells that w is not before one. A direction beyond the last end is
        // there by rounding.
        bool begun = !self.central || peters_det(s.s0, w) >= 0.0;
        if (!found && s.area > 0.0 && begun) {
            bool ends = peters_det(w, s.s1) > 0.0;
            float part = nusselt_min(nusselt_max(azimuth_sector_area_to(s, w, self.central), 0.0), s.area);
            area = before + (ends ? part : s.area);
            float outer = peters_form(s.outer, w);
            float inner = peters_form(s.inner, w);
            float gap = inner - outer;
            height = self.central ? outer : outer * (inner - 1.0) / (gap > 0.0 ? gap : 1.0);
            found = ends;
        }
        before = before + s.area;
    }
    return vec2(below_one(area * self.inverse_total), below_one(height));
}

#endif
