#ifndef NUSSELT_SAMPLING_AZIMUTHAL_SWEEP_GLSL
#define NUSSELT_SAMPLING_AZIMUTHAL_SWEEP_GLSL
// Follows include/nusselt/sampling/azimuthal_sweep.h @ e862c8f5cbcc
/// Cuts a polygon beside the zenith into sectors at the azimuths of its vertices, each bounded by one outer and one
/// inner edge (Peters 2021, polygonal lights, Sec. 3.7). Twin of include/nusselt/sampling/azimuthal_sweep.h.

#include "../geometry/convex_polygon.glsl"
#include "../geometry/sorting_network.glsl"
#include "../sampling/decentral_sector.glsl"

/// A vertex and the edge that begins there when going counterclockwise around the zenith. Points are offsets from
/// vertex 0, accurate relative to the size of the light.
struct SweepEvent {
    float azimuth;
    vec3 offset;
    vec3 edge;  ///< counterclockwise
    float kind; ///< 1: an outer edge begins, -1: an inner one, 0: neither
};

/// The position of the sweep on the outer or the inner edges.
struct SweepChain {
    vec3 at;
    vec3 rest; ///< of the edge
    bool begun;
};

struct AzimuthalSweep {
    SweepEvent event[kNusseltSlots]; ///< by azimuth
    SweepChain outer, inner;
    float gap; ///< between both chains
    vec3 base; ///< vertex 0
    vec3 normal;
    float distance; ///< of the plane of the polygon from the origin
};

/// Azimuth of a vertex relative to vertex 0, by a measure of angles that grows with them, and its error.
struct SweepAzimuth {
    float angle, rounding;
};

/// Rounding of an azimuth above which a vertex is next to the zenith: closer than a thousandth of the size.
const float kVagueAzimuth = 0.00048828125; // 2^-11

SweepAzimuth sweep_azimuth_of(vec3 base, vec3 vertex, vec3 offset, float reach) {
    float sine = det(base.xy, offset.xy);
    float cosine = dot(base.xy, vertex.xy);
    float sum = abs(sine) + abs(cosine);
    float inverse_sum = 1.0 / (sum > 0.0 ? sum : 1.0);
    float ratio = sine * inverse_sum;
    float size = (abs(base.x) + abs(base.y)) * reach;
    return SweepAzimuth(cosine < 0.0 ? copysign(2.0, sine) - ratio : ratio,
                        (4.0 * kNusseltEpsilon) * inverse_sum * size);
}

/// Measures the azimuth of each vertex relative to vertex 0.
/// \param offset, azimuth become those of the vertices.
/// \return the largest rounding error of an azimuth.
float sweep_find_azimuths(ConvexPolygon polygon, out vec3 offset[kNusseltSlots],
                          out SweepAzimuth azimuth[kNusseltSlots]) {
    offset[0] = vec3(0.0);
    azimuth[0] = SweepAzimuth(0.0, 0.0);
    float reach = 0.0; // of the sums of edges, which rounding of the offsets is proportional to
    float rounding = 0.0;
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots; ++j) {
        offset[j] = offset[j - 1] + polygon.edge[j - 1];
        reach = nusselt_max(reach, abs(offset[j].x) + abs(offset[j].y));
        azimuth[j] = sweep_azimuth_of(polygon.vertex[0], polygon.vertex[j], offset[j], reach);
        rounding = nusselt_max(rounding, azimuth[j].rounding);
    }
    return rounding;
}

/// The same polygon, with the vertex that is closest to the zenith first.
ConvexPolygon turned_to_zenith(ConvexPolygon polygon) {
    int turns = 0; // by how many vertices
    float least = abs(polygon.vertex[0].x) + abs(polygon.vertex[0].y);
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots; ++j) {
        float reach = abs(polygon.vertex[j].x) + abs(polygon.vertex[j].y);
        turns = reach < least ? j : turns;
        least = nusselt_min(least, reach);
    }
    for (int k = 0; k < turns; ++k) {
        vec3 first_vertex = polygon.vertex[0], first_edge = polygon.edge[0];
        NUSSELT_UNROLL for (int j = 0; j + 1 < kNusseltSlots; ++j) {
            polygon.vertex[j] = polygon.vertex[j + 1];
            polygon.edge[j] = polygon.edge[j + 1];
        }
        polygon.vertex[kNusseltSlots - 1] = first_vertex;
        polygon.edge[kNusseltSlots - 1] = first_edge;
    }
    return polygon;
}

/// Makes azimuths equal if they are so up to rounding: the less certain one takes over the other.
void unite_azimuths(inout SweepAzimuth a, inout SweepAzimuth b) {
    if (!(abs(a.angle - b.angle) <= nusselt_max(a.rounding, b.rounding))) return;
    if (a.rounding >= b.rounding) {
        a = b;
    } else {
        b = a;
    }
}

/// Sorts two events by azimuth. Of equal azimuths, outer edges come first: the result shall not depend on the network.
void compare_and_swap(inout SweepEvent a, inout SweepEvent b) {
    if (b.azimuth < a.azimuth || (b.azimuth == a.azimuth && b.kind > a.kind)) {
        SweepEvent c = a;
        a = b;
        b = c;
    }
}

/// The vertex whose projection to the tangent plane is smaller: it has the smaller rounding error.
vec3 closer_to_zenith(vec3 a, vec3 b) {
    return abs(a.x) + abs(a.y) <= abs(b.x) + abs(b.y) ? a : b;
}

/// \param polygon  clockwise as seen from the origin, beside the zenith.
/// \param distance of its plane from the origin: dot(polygon.normal, p) for a point p of it.
AzimuthalSweep azimuthal_sweep_prepare(ConvexPolygon polygon, float distance) {
    AzimuthalSweep sweep;
    sweep.normal = polygon.normal;
    sweep.distance = distance;
    vec3 offset[kNusseltSlots];
    SweepAzimuth azimuth[kNusseltSlots];
    if (sweep_find_azimuths(polygon, offset, azimuth) > kVagueAzimuth) {
        // A vertex next to the zenith has a definite azimuth only if it is vertex 0, whose offset is not rounded.
        polygon = turned_to_zenith(polygon);
        sweep_find_azimuths(polygon, offset, azimuth);
    }
    // Edges that have one azimuth as far as rounding can tell are neither outer nor inner ones. In both directions, for
    // runs of such edges.
    NUSSELT_UNROLL for (int j = 1; j < kNusseltSlots; ++j) unite_azimuths(azimuth[j], azimuth[j - 1]);
    unite_azimuths(azimuth[0], azimuth[kNusseltSlots - 1]);
    NUSSELT_UNROLL for (int j = kNusseltSlots - 1; j > 0; --j) unite_azimuths(azimuth[j - 1], azimuth[j]);
    sweep.base = polygon.vertex[0];

    sweep.inner = SweepChain(vec3(0.0), vec3(0.0), false);
    NUSSELT_UNROLL for (int j = 0; j < kNusseltSlots; ++j) {
        int before = j > 0 ? j - 1 : kNusseltSlots - 1;
        int after = j + 1 < kNusseltSlots ? j + 1 : 0;
        bool is_outer = azimuth[after].angle > azimuth[j].angle;
        bool is_inner = azimuth[before].angle > azimuth[j].angle;
        vec3 backward = -polygon.edge[before];
        // At the clockwise end of the polygon an outer and an inner edge begin at the same vertex: the inner one is
        // kept aside.
        if (is_outer && is_inner) sweep.inner = SweepChain(offset[j], backward, true);
        sweep.event[j] = SweepEvent(azimuth[j].angle, offset[j], is_outer ? polygon.edge[j] : backward,
                                    is_outer ? 1.0 : (is_inner ? -1.0 : 0.0));
    }
#define NUSSELT_SORT_EVENTS(low, high) compare_and_swap(sweep.event[low], sweep.event[high]);
    NUSSELT_SORT_BY_NETWORK(NUSSELT_SORT_EVENTS)
#undef NUSSELT_SORT_EVENTS

    sweep.outer = SweepChain(sweep.event[0].offset, sweep.event[0].edge, sweep.event[0].kind > 0.0);
    if (sweep.event[0].kind < 0.0) sweep.inner = SweepChain(sweep.event[0].offset, sweep.event[0].edge, true);
    sweep.gap = 0.0;
    return sweep;
}

/// Brings both chains to the azimuth of a vertex, where one of them continues with another edge. No edge begins at
/// repeated vertices and at ends of edges with one azimuth.
void sweep_pass(inout AzimuthalSweep self, const SweepEvent at) {
    if (at.kind == 0.0) return;
    bool outer_begins = at.kind > 0.0;
    vec3 from = outer_begins ? self.inner.at : self.outer.at;
    vec3 along = outer_begins ? self.inner.rest : self.outer.rest;

    // Intersect the other chain with the azimuth.
    vec3 vertex = self.base + at.offset;
    vec3 start = self.base + from;
    vec3 step = at.offset - from;
    float way = det(closer_to_zenith(start, vertex).xy, step.xy); // positive if the vertex lies counterclockwise
    float slope = det(vertex.xy, along.xy);
    float safe_slope = slope > 0.0 ? slope : 1.0;
    float x = nusselt_min(nusselt_max(way / safe_slope, 0.0), 1.0);

    float turn = det(closer_to_zenith(start, start + along).xy, along.xy);
    AzimuthOnEdge azimuth = AzimuthOnEdge(vertex.xy, along, step, way, slope);
    self.gap = azimuth_on_edge_gap(azimuth, self.normal, self.distance, outer_begins ? -turn : safe_slope);

    SweepChain begun = SweepChain(at.offset, at.edge, true);
    SweepChain other = SweepChain(from + x * along, (1.0 - x) * along, outer_begins ? self.inner.begun : self.outer.begun);
    if (outer_begins) {
        self.outer = begun;
        self.inner = other;
    } else {
        self.outer = other;
        self.inner = begun;
    }
}

/// Height of the plane through the origin and an inner edge above the point of the outer edge that has the same
/// azimuth. Both points lie in the plane of the polygon, whose distance is a common factor: only the step between them
/// matters.
float sweep_end_gap(vec3 base, vec3 normal, float distance, vec3 outer, vec3 inner) {
    vec3 outward = outer - inner;
    vec2 azimuth = base.xy + inner.xy;
    float upright = normal.z * dot(azimuth, azimuth);
    float level = dot(normal.xy, azimuth);
    // The larger component of the normal within the vertical plane of this azimuth.
    bool is_flat = normal.z * upright >= level * level;
    float numerator = distance * (is_flat ? dot(outward.xy, azimuth) : -outward.z);
    float denominator = is_flat ? upright : level;
    return nusselt_max(numerator / (denominator != 0.0 ? denominator : 1.0), 0.0);
}

/// Goes on to event k, 1 to NUSSELT_MAX_VERTICES in turn: counterclockwise.
/// \param sector up to this event.
/// \return       whether the sector exists.
bool azimuthal_sweep_advance(inout AzimuthalSweep self, int k, out DecentralSector sector) {
    bool open = self.outer.begun && self.inner.begun;
    vec3 begin = self.outer.at;
    sector.begin_gap = self.gap;
    if (k + 1 < kNusseltSlots) {
        sweep_pass(self, self.event[k]);
    } else {
        // Both chains end at the last azimuth.
        self.outer.at = self.outer.at + self.outer.rest;
        self.inner.at = self.inner.at + self.inner.rest;
        self.gap = sweep_end_gap(self.base, self.normal, self.distance, self.outer.at, self.inner.at);
    }
    // Above the horizon in spite of rounding.
    sector.begin = vec3((self.base + begin).xy, nusselt_max(self.base.z + begin.z, 0.0));
    sector.chord = self.outer.at - begin;
    sector.end_gap = self.gap;
    sector.doubled_triangle = det(sector.begin.xy, sector.chord.xy);
    return open && sector.doubled_triangle > 0.0;
}

#endif
