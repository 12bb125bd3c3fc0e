#ifndef NUSSELT_SAMPLING_POLYGON_PROJECTED_SOLID_ANGLE_GLSL
#define NUSSELT_SAMPLING_POLYGON_PROJECTED_SOLID_ANGLE_GLSL
// Follows include/nusselt/sampling/polygon_projected_solid_angle.h @ e185e7c90b02
/// Uniform sampling of the projected solid angle of a convex polygon: density proportional to the cosine at the
/// surface. With a Lambertian emitter on a Lambertian surface, all noise that remains comes from shadows.
///
/// C. Peters 2021, BRDF Importance Sampling for Polygonal Lights, ACM TOG 40(4), doi:10.1145/3450626.3459672: Sec. 3.
/// Twin of include/nusselt/sampling/polygon_projected_solid_angle.h, where the deviations stand.
///
/// Measure: pdf is the density of wi with respect to solid angle [1/sr], wi.z over the measure.
/// Space: shading space; the shading point is the origin, the normal +z. Clips to the horizon by itself.
/// Edge cases: no part above the horizon, no area, or origin in the plane of the polygon: pdf = 0, measure 0.

#include "../core/light_sample.glsl"
#include "../geometry/clip_polygon.glsl"
#include "../geometry/polygon_hull.glsl"
#include "../geometry/polygon_measures.glsl"
#include "../sampling/azimuthal_sweep.glsl"

/// Coordinates are scaled to an extent of order one, and mirrored.
struct PolygonProjectedSolidAngle {
    PolygonHull hull;      ///< of the light above the horizon
    float mirror;          ///< -1 if y is mirrored to get the expected winding
    float inverse_scale;   ///< a power of two
    bool central;          ///< the zenith is in the polygon or on its boundary
    float doubled_total;   ///< twice the projected solid angle
    float inverse_measure; ///< 0 without light
    vec3 begin[kNusseltSlots];           ///< where the outer edge of each sector begins, in order of azimuth
    vec3 chord[kNusseltSlots];           ///< the part of the edge in the sector
    float begin_gap[kNusseltSlots];      ///< see DecentralSector; decentral case only
    float end_gap[kNusseltSlots];
    float angle_per_area[kNusseltSlots]; ///< on the great circle of the edge, per doubled area; central case only
    float doubled_area[kNusseltSlots];   ///< twice the area of each sector, 0 for those without light
};

/// Whether the zenith is in the polygon or on its boundary.
/// \param distance of the plane of the polygon from the origin.
/// \param highest  z of the highest vertex.
bool is_central(ConvexPolygon polygon, float distance, float highest) {
    float reach = 0.0;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j)
        reach = nusselt_max(reach, abs(polygon.vertex[j].x) + abs(polygon.vertex[j].y));
    float rounding = (8.0 * kNusseltEpsilon) * reach;
    bool has_inner = false;
    bool touches_zenith = false;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        vec3 v = polygon.vertex[j];
        vec3 next = polygon.vertex[j + 1 < kNusseltSlots ? j + 1 : 0];
        vec3 edge = polygon.edge[j];
        float turn = det(closer_to_zenith(v, next).xy, edge.xy);
        // An edge on the horizon bounds the whole disk: it can only be an outer one, despite rounding.
        bool on_horizon = nusselt_max(v.z, next.z) == 0.0;
        has_inner = has_inner || (turn < 0.0 && !on_horizon);
        // On the boundary within rounding, no edge determines on which side the zenith is.
        bool at_vertex = v.z > 0.0 && abs(v.x) + abs(v.y) <= rounding;
        bool on_edge = dot(v.xy, next.xy) < 0.0 && abs(turn) <= rounding * (abs(edge.x) + abs(edge.y));
        touches_zenith = touches_zenith || at_vertex || on_edge;
    }
    if (has_inner && !touches_zenith) return false;
    // On the zenith's axis, the plane has the height distance / normal.z: some vertex is at least as high if the light
    // is there. The edges of strips along the horizon are less conclusive.
    if (distance * polygon.normal.z < 0.0) return false;
    float beyond = nusselt_fma(-abs(polygon.normal.z), highest, abs(distance)) - 8.0 * kNusseltEpsilon;
    if (beyond <= 0.0) return true;
    // The corners of a warped polygon are beside its plane, maybe those on the axis.
    return beyond <= warp_of(polygon, distance);
}

/// The arc of the great circle of an edge, which together with the zenith bounds a sector in the central case: Prop. 1
/// simplifies to Lambert's formula.
struct CentralArc {
    bool present;
    float height;         ///< z of the normal of the plane through the origin and the edge, not normalised
    float sine, cosine;   ///< of the angle, not normalised; the sine is the length of that normal
    float angle_per_area; ///< per doubled area of the sector; 0 if not finite or not present
};

/// \param v, next ends of the edge.
CentralArc central_arc(vec3 v, vec3 next, vec3 edge) {
    vec3 n = nusselt_cross(v, edge);
    float sine = sqrt(dot(n, n));
    bool present = n.z > 0.0 && sine > 0.0 && det(closer_to_zenith(v, next).xy, edge.xy) > 0.0;
    float ratio = sine / (present ? n.z : 1.0);
    return CentralArc(present, n.z, sine, dot(v, next), present && is_finite(ratio) ? ratio : 0.0);
}

/// All of sector k but its area, in the central case.
CentralArc polygon_projected_solid_angle_put_edge(inout PolygonProjectedSolidAngle self, int k,
                                                  ConvexPolygon polygon) {
    vec3 next = polygon.vertex[k + 1 < kNusseltSlots ? k + 1 : 0];
    CentralArc arc = central_arc(polygon.vertex[k], next, polygon.edge[k]);
    self.begin[k] = polygon.vertex[k];
    self.chord[k] = polygon.edge[k];
    self.angle_per_area[k] = arc.angle_per_area;
    return arc;
}

/// Sector k in the decentral case.
/// \param doubled twice its area.
void polygon_projected_solid_angle_put(inout PolygonProjectedSolidAngle self, int k, const DecentralSector sector,
                                       float doubled) {
    self.begin[k] = sector.begin;
    self.chord[k] = sector.chord;
    self.begin_gap[k] = sector.begin_gap;
    self.end_gap[k] = sector.end_gap;
    self.doubled_area[k] = is_finite(doubled) ? doubled : 0.0;
}

void polygon_projected_solid_angle_prepare_central(inout PolygonProjectedSolidAngle self, const ConvexPolygon polygon) {
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k) {
        CentralArc arc = polygon_projected_solid_angle_put_edge(self, k, polygon);
        if (arc.present) self.doubled_area[k] = arc.height * atan2_positive(arc.sine, arc.cosine) / arc.sine;
    }
}

/// Each part of an azimuth between two vertices has a sector.
void polygon_projected_solid_angle_prepare_decentral(inout PolygonProjectedSolidAngle self,
                                                     const ConvexPolygon polygon) {
    AzimuthalSweep sweep = azimuthal_sweep_prepare(polygon, self.hull.distance);
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots - 1; ++k) {
        DecentralSector sector;
        if (azimuthal_sweep_advance(sweep, k + 1, sector))
            polygon_projected_solid_angle_put(
                self, k, sector, decentral_sector_doubled_area_to(sector, decentral_sector_planes(sector), 1.0));
    }
}

/// All but the sectors.
/// \param light   in shading space, either winding [m].
/// \param polygon the part above the horizon, mirrored and with coordinates of order one.
PolygonProjectedSolidAngle polygon_projected_solid_angle_begin(const ConvexPolygon light, out ConvexPolygon polygon) {
    PolygonProjectedSolidAngle self;
    polygon = with_unit_extent(light);
    self.inverse_scale = reciprocal_power_of_two(unit_extent_scale(light));
    float distance = plane_distance(polygon);
    // The method wants the winding that is clockwise as seen from the origin: mirror y otherwise.
    self.mirror = copysign(1.0, distance);
    polygon.normal.y = self.mirror * polygon.normal.y;
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        polygon.vertex[j].y = self.mirror * polygon.vertex[j].y;
        polygon.edge[j].y = self.mirror * polygon.edge[j].y;
    }
    if (!is_above_horizon(polygon)) {
        // Once more to an extent of order one, since little may be left of the light.
        polygon = clip_to_horizon(polygon);
        float scale = unit_extent_scale(polygon);
        self.inverse_scale = self.inverse_scale * reciprocal_power_of_two(scale);
        polygon = with_unit_extent(polygon);
        distance = scale * distance;
    }
    self.hull = hull_of(polygon, distance);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        self.begin[j] = vec3(0.0);
        self.chord[j] = vec3(0.0);
        self.begin_gap[j] = 0.0;
        self.end_gap[j] = 0.0;
        self.angle_per_area[j] = 0.0;
        self.doubled_area[j] = 0.0;
    }
    self.central = is_central(polygon, distance, self.hull.high.z);
    return self;
}

/// Adds up the sectors.
PolygonProjectedSolidAngle polygon_projected_solid_angle_end(PolygonProjectedSolidAngle self) {
    self.doubled_total = 0.0;
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k)
        self.doubled_total = self.doubled_total + self.doubled_area[k];
    self.inverse_measure = 0.5 * self.doubled_total > 0.0 ? 2.0 / self.doubled_total : 0.0;
    return self;
}

/// \param light in shading space, either winding [m].
PolygonProjectedSolidAngle polygon_projected_solid_angle_prepare(const ConvexPolygon light) {
    ConvexPolygon polygon;
    PolygonProjectedSolidAngle self = polygon_projected_solid_angle_begin(light, polygon);
    if (self.hull.distance != 0.0) {
        if (self.central) {
            polygon_projected_solid_angle_prepare_central(self, polygon);
        } else {
            polygon_projected_solid_angle_prepare_decentral(self, polygon);
        }
    }
    return polygon_projected_solid_angle_end(self);
}

/// Projected solid angle of the part of the light above the horizon [sr].
float polygon_projected_solid_angle_measure(const PolygonProjectedSolidAngle self) { return 0.5 * self.doubled_total; }

/// \param wi a unit direction towards the light.
float polygon_projected_solid_angle_pdf(const PolygonProjectedSolidAngle self, vec3 wi) {
    float density = wi.z * self.inverse_measure;
    return wi.z > 0.0 && is_finite(density) ? density : 0.0;
}

/// The sector that a random number falls into.
struct ProjectedSectorSelection {
    DecentralSector sector; ///< in the central case the gaps mean nothing
    float doubled_area, angle_per_area;
    float rest; ///< of the doubled area, up to the sample
};

ProjectedSectorSelection polygon_projected_solid_angle_select(PolygonProjectedSolidAngle self, float u) {
    float target = u * self.doubled_total;
    ProjectedSectorSelection s;
    s.sector.begin = self.begin[0];
    s.sector.chord = self.chord[0];
    s.sector.begin_gap = self.begin_gap[0];
    s.sector.end_gap = self.end_gap[0];
    s.angle_per_area = self.angle_per_area[0];
    s.doubled_area = self.doubled_area[0];
    float before = self.doubled_area[0];
    float first = 0.0;
    NUSSELT_UNROLL for (int k = 1; k < kNusseltSlots; ++k) {
        bool reached = self.doubled_area[k] > 0.0 && target >= before;
        s.sector.begin = reached ? self.begin[k] : s.sector.begin;
        s.sector.chord = reached ? self.chord[k] : s.sector.chord;
        s.sector.begin_gap = reached ? self.begin_gap[k] : s.sector.begin_gap;
        s.sector.end_gap = reached ? self.end_gap[k] : s.sector.end_gap;
        s.angle_per_area = reached ? self.angle_per_area[k] : s.angle_per_area;
        s.doubled_area = reached ? self.doubled_area[k] : s.doubled_area;
        first = reached ? before : first;
        before = before + self.doubled_area[k];
    }
    s.sector.doubled_triangle = det(s.sector.begin.xy, s.sector.chord.xy);
    s.rest = nusselt_min(nusselt_max(nusselt_fma(u, self.doubled_total, -first), 0.0), s.doubled_area);
    return s;
}

/// Sec. 3.2 in three dimensions: equal areas between the zenith and the edge are equal angles on its circle.
LightSample polygon_projected_solid_angle_sample_central(const LightPlane plane, const ProjectedSectorSelection s,
                                                         float u) {
    vec3 n = nusselt_cross(s.sector.begin, s.sector.chord);
    vec3 a = inverse_length(s.sector.begin) * s.sector.begin;
    vec3 t = inverse_length(n) * cross(n, a); // orthogonal: nothing cancels
    SinCos angle = sincos_half_turn(nusselt_min(s.rest * s.angle_per_area, kNusseltPi));
    vec3 q = nusselt_fma(angle.cosine, a, angle.sine * t);
    float root = sqrt(u);
    vec3 wi = vec3(root * q.xy, sqrt(nusselt_fma(u, q.z * q.z, 1.0 - u)));
    return LightSample(wi, 0.0, light_plane_distance_along(plane, wi) * wi);
}

/// \param x position of the azimuth on the chord of the sector.
LightSample polygon_projected_solid_angle_sample_decentral(const LightPlane plane, const DecentralSector sector,
                                                           float x, float u) {
    DecentralForms forms = decentral_sector_at(sector, x);
    // The squared radius is uniform between the ellipses: the reciprocal of the form is. The form of the circle through
    // the sample gives its height above the outer point, in the same azimuth.
    float inner = forms.outer + forms.rise;
    float v = 1.0 - u;
    float mixed = nusselt_fma(u, inner, v * forms.outer);
    float rise = v * forms.outer * forms.rise / (mixed > 0.0 ? mixed : 1.0);
    float z = forms.outer_point.z;
    float top = z + sqrt(nusselt_fma(z, z, rise));
    float lift = nusselt_min(rise / (top > 0.0 ? top : 1.0), forms.gap);
    vec3 direction = vec3(forms.outer_point.xy, z + lift);
    float inverse_norm = inverse_length(direction);
    // The lifted point lies on the ray to the sample; scale it to the plane of the light, but not beyond the farthest
    // vertex.
    float lifted = nusselt_fma(lift, plane.normal.z, plane.distance);
    float stretch = plane.distance * lifted > 0.0 ? plane.distance / lifted : 1.0;
    float along = nusselt_min(stretch, plane.farthest * inverse_norm);
    return LightSample(inverse_norm * direction, 0.0, along * direction);
}

/// Takes scaled and mirrored coordinates back to those of the light.
LightSample polygon_projected_solid_angle_finish(const PolygonProjectedSolidAngle self, LightSample s) {
    s.p = self.inverse_scale * polygon_hull_moved_to_plane(self.hull, s.p);
    s.wi = self.inverse_measure > 0.0 ? s.wi : vec3(0.0, 0.0, 1.0);
    s.wi.y = self.mirror * s.wi.y;
    s.p.y = self.mirror * s.p.y;
    s.pdf = polygon_projected_solid_angle_pdf(self, s.wi);
    return s;
}

/// \param x position of the azimuth on the chord of the sector; decentral case only.
LightSample polygon_projected_solid_angle_sample_at(const PolygonProjectedSolidAngle self,
                                                    const ProjectedSectorSelection s,
                                                    float x, float u) {
    LightSample result;
    if (self.central) {
        result = polygon_projected_solid_angle_sample_central(polygon_hull_plane(self.hull), s, u);
    } else {
        result = polygon_projected_solid_angle_sample_decentral(polygon_hull_plane(self.hull), s.sector, x, u);
    }
    return polygon_projected_solid_angle_finish(self, result);
}

/// \param u in [0, 1)^2; x selects the azimuth, y the inclination. Continuous, up to the cyclic start in the central
///          case, so that stratification survives.
LightSample polygon_projected_solid_angle_sample(const PolygonProjectedSolidAngle self, vec2 u) {
    ProjectedSectorSelection s = polygon_projected_solid_angle_select(self, u.x);
    float x = 0.0;
    if (!self.central) x = decentral_sector_position(s.sector, s.rest, s.doubled_area);
    return polygon_projected_solid_angle_sample_at(self, s, x, u.y);
}

/// Where between the inner ellipse (0; the zenith in the central case) and the outer one (1) a direction with the
/// projection w and height z above x lies, in squared radii.
float relative_height_in_sector(bool central, const DecentralSector sector, float x, vec2 w, float z) {
    DecentralForms forms = decentral_sector_at(sector, x);
    float across = dot(forms.outer_point.xy, forms.outer_point.xy);
    float radius = sqrt(dot(w, w));
    // Height and form of the direction above the outer point.
    float height = sqrt(across) * z / (radius > 0.0 ? radius : 1.0);
    float form = nusselt_fma(height, height, across);
    if (central) return radius > 0.0 ? forms.outer / (form > 0.0 ? form : 1.0) : 0.0;
    float from_inner = forms.outer_point.z + forms.gap - height;
    float below = from_inner * (forms.outer_point.z + forms.gap + height);
    return form > 0.0 && forms.rise > 0.0 ? forms.outer * below / (form * forms.rise) : 0.0;
}

/// The position of a direction.
struct ProjectedSectorPosition {
    DecentralSector sector; ///< in the central case the gaps mean nothing
    float doubled_area, angle_per_area;
    float before; ///< doubled area of the sectors before this one
    float x;      ///< position of the azimuth on the chord of the sector
};

/// The sector that a unit direction on the light falls into; one without area if there is none.
/// \param w the direction in the tangent plane, mirrored.
ProjectedSectorPosition polygon_projected_solid_angle_locate(PolygonProjectedSolidAngle self, vec2 w) {
    ProjectedSectorPosition at =
        ProjectedSectorPosition(DecentralSector(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0), 0.0, 0.0, 0.0, 0.0);
    bool found = self.doubled_total <= 0.0;
    float before = 0.0;
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k) {
        DecentralSector sector = DecentralSector(self.begin[k], self.chord[k], self.begin_gap[k], self.end_gap[k],
                                                 det(self.begin[k].xy, self.chord[k].xy));
        float from_start = det(sector.begin.xy, w);
        vec3 end = sector.begin + sector.chord;
        float to_end = det(w, end.xy);
        // A sector also has what rounding moved beyond its ends: there may be no other one. In the decentral case, the
        // order of the sectors takes care of that.
        float tolerance = (4.0 * kNusseltEpsilon) * (abs(w.x) + abs(w.y));
        float begin_slack = tolerance * (abs(sector.begin.x) + abs(sector.begin.y));
        float end_slack = tolerance * (abs(end.x) + abs(end.y));
        bool inside = from_start >= -begin_slack && to_end >= -end_slack;
        if (!found && self.doubled_area[k] > 0.0 && (!self.central || inside)) {
            // The chord meets the ray along w.
            float slope = det(w, sector.chord.xy);
            float x = nusselt_min(nusselt_max(from_start / (slope > 0.0 ? slope : 1.0), 0.0), 1.0);
            at = ProjectedSectorPosition(sector, self.doubled_area[k], self.angle_per_area[k], before, x);
            found = self.central || to_end > 0.0;
        }
        before = before + self.doubled_area[k];
    }
    return at;
}

/// Twice the area of a central sector from its start to x.
/// \param angle of that part on the great circle.
float central_sector_doubled_area(const ProjectedSectorPosition at, float angle) {
    return angle / (at.angle_per_area > 0.0 ? at.angle_per_area : 1.0);
}

/// Sine and cosine, not normalised, of the angle on the great circle of a central sector from its start to x.
SinCos central_sector_angle(const ProjectedSectorPosition at) {
    vec3 n = at.x * nusselt_cross(at.sector.begin, at.sector.chord);
    return SinCos(sqrt(dot(n, n)), dot(at.sector.begin, at.sector.begin + at.x * at.sector.chord));
}

/// \param partial_area twice the area of the sector from its start to x.
/// \param w, z         the direction in the tangent plane, mirrored, and its height.
vec2 polygon_projected_solid_angle_random_numbers(const PolygonProjectedSolidAngle self,
                                                  const ProjectedSectorPosition at,
                                                  float partial_area, vec2 w, float z) {
    float area_before = at.before + nusselt_min(partial_area, at.doubled_area);
    float height = relative_height_in_sector(self.central, at.sector, at.x, w, z);
    return vec2(below_one(area_before / (self.doubled_total > 0.0 ? self.doubled_total : 1.0)), below_one(height));
}

/// The random numbers for which the sample is wi, a unit direction on the light. At the zenith, and where a light is so
/// thin that its width is lost to rounding, the component without meaning is 0.
vec2 polygon_projected_solid_angle_invert(const PolygonProjectedSolidAngle self, vec3 wi) {
    vec2 w = vec2(wi.x, self.mirror * wi.y);
    ProjectedSectorPosition at = polygon_projected_solid_angle_locate(self, w);
    float partial_area;
    if (self.central) {
        SinCos angle = central_sector_angle(at);
        partial_area = central_sector_doubled_area(at, atan2_positive(angle.sine, angle.cosine));
    } else {
        partial_area = decentral_sector_doubled_area_to(at.sector, decentral_sector_planes(at.sector), at.x);
    }
    return polygon_projected_solid_angle_random_numbers(self, at, partial_area, w, wi.z);
}

#endif
