#ifndef NUSSELT_SAMPLING_POLYGON_PROJECTED_SOLID_ANGLE_BIASED_GLSL
#define NUSSELT_SAMPLING_POLYGON_PROJECTED_SOLID_ANGLE_BIASED_GLSL
// Follows include/nusselt/sampling/polygon_projected_solid_angle.h @ e185e7c90b02
/// The biased variant of polygon_projected_solid_angle.glsl (Peters 2021, polygonal lights, Sec. 6.4): no iteration,
/// fast arctangents. The density is that of exact projected solid angle sampling, which the samples follow
/// approximately: estimates are biased accordingly. Twin of PolygonProjectedSolidAngleBiased in
/// include/nusselt/sampling/polygon_projected_solid_angle.h.
///
/// Measure, space and edge cases are those of the exact variant.

#include "../sampling/polygon_projected_solid_angle.glsl"

/// The preparation of the exact variant, up to errors of the arctangents of 1.3e-5 rad.
struct PolygonProjectedSolidAngleBiased {
    PolygonProjectedSolidAngle approximate;
};

void polygon_projected_solid_angle_biased_prepare_central(inout PolygonProjectedSolidAngle self,
                                                          const ConvexPolygon polygon) {
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k) {
        CentralArc arc = polygon_projected_solid_angle_put_edge(self, k, polygon);
        if (arc.present) self.doubled_area[k] = arc.height * atan2_positive_fast(arc.sine, arc.cosine) / arc.sine;
    }
}

void polygon_projected_solid_angle_biased_prepare_decentral(inout PolygonProjectedSolidAngle self,
                                                            const ConvexPolygon polygon) {
    AzimuthalSweep sweep = azimuthal_sweep_prepare(polygon, self.hull.distance);
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots - 1; ++k) {
        DecentralSector sector;
        if (azimuthal_sweep_advance(sweep, k + 1, sector))
            polygon_projected_solid_angle_put(
                self, k, sector,
                decentral_sector_fast_doubled_area_to(sector, decentral_sector_planes(sector), 1.0));
    }
}

/// \param light in shading space, either winding [m].
PolygonProjectedSolidAngleBiased polygon_projected_solid_angle_biased_prepare(const ConvexPolygon light) {
    ConvexPolygon polygon;
    PolygonProjectedSolidAngle self = polygon_projected_solid_angle_begin(light, polygon);
    if (self.hull.distance != 0.0) {
        if (self.central) {
            polygon_projected_solid_angle_biased_prepare_central(self, polygon);
        } else {
            polygon_projected_solid_angle_biased_prepare_decentral(self, polygon);
        }
    }
    return PolygonProjectedSolidAngleBiased(polygon_projected_solid_angle_end(self));
}

/// Projected solid angle of the part of the light above the horizon [sr].
float polygon_projected_solid_angle_biased_measure(const PolygonProjectedSolidAngleBiased self) {
    return polygon_projected_solid_angle_measure(self.approximate);
}

/// \param wi a unit direction towards the light.
float polygon_projected_solid_angle_biased_pdf(const PolygonProjectedSolidAngleBiased self, vec3 wi) {
    return polygon_projected_solid_angle_pdf(self.approximate, wi);
}

/// \param u in [0, 1)^2; x selects the azimuth, y the inclination.
LightSample polygon_projected_solid_angle_biased_sample(const PolygonProjectedSolidAngleBiased self, vec2 u) {
    ProjectedSectorSelection s = polygon_projected_solid_angle_select(self.approximate, u.x);
    float x = 0.0;
    if (!self.approximate.central) {
        float fraction = s.rest / (s.doubled_area > 0.0 ? s.doubled_area : 1.0);
        x = decentral_sector_initial_position(s.sector, nusselt_min(fraction, 1.0));
    }
    return polygon_projected_solid_angle_sample_at(self.approximate, s, x, u.y);
}

/// The random numbers for which exact sampling would give wi, a unit direction on the light, up to the error of the
/// arctangents.
vec2 polygon_projected_solid_angle_biased_invert(const PolygonProjectedSolidAngleBiased self, vec3 wi) {
    vec2 w = vec2(wi.x, self.approximate.mirror * wi.y);
    ProjectedSectorPosition at = polygon_projected_solid_angle_locate(self.approximate, w);
    float partial_area;
    if (self.approximate.central) {
        SinCos angle = central_sector_angle(at);
        partial_area = central_sector_doubled_area(at, atan2_positive_fast(angle.sine, angle.cosine));
    } else {
        partial_area = decentral_sector_fast_doubled_area_to(at.sector, decentral_sector_planes(at.sector), at.x);
    }
    return polygon_projected_solid_angle_random_numbers(self.approximate, at, partial_area, w, wi.z);
}

#endif
