#ifndef NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_BISECTION_GLSL
#define NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_BISECTION_GLSL
// Follows include/nusselt/related/polygon_projected_solid_angle_bisection.h @ bbed014c0735
/// A published method, to compare with: projected solid angle sampling by azimuth and inclination, inverted by six
/// bisections. J. Arvo 2001, Stratified Sampling of 2-Manifolds; D. Hart et al. 2020, Practical Product Sampling by Fitting
/// and Composing Warps, CGF 39(4), doi:10.1111/cgf.14060. Use polygon_projected_solid_angle.glsl instead: samples lie on 64
/// azimuths of each sector. Twin of include/nusselt/related/polygon_projected_solid_angle_bisection.h, which lists known
/// failures.
///
/// Measure and space as polygon_projected_solid_angle.glsl.

#include "../related/azimuth_sectors.glsl"

const int kNusseltBisections = 6;

struct PolygonProjectedSolidAngleBisection {
    AzimuthSectors sectors;
};

/// \param light in shading space, either winding [m].
PolygonProjectedSolidAngleBisection polygon_projected_solid_angle_bisection_prepare(const ConvexPolygon light) {
    return PolygonProjectedSolidAngleBisection(azimuth_sectors_prepare(light));
}

/// \copydoc azimuth_sectors_measure
float polygon_projected_solid_angle_bisection_measure(const PolygonProjectedSolidAngleBisection self) {
    return azimuth_sectors_measure(self.sectors);
}

/// \copydoc azimuth_sectors_pdf
float polygon_projected_solid_angle_bisection_pdf(const PolygonProjectedSolidAngleBisection self, vec3 wi) {
    return azimuth_sectors_pdf(self.sectors, wi);
}

/// \copydoc azimuth_sectors_invert
vec2 polygon_projected_solid_angle_bisection_invert(const PolygonProjectedSolidAngleBisection self, vec3 wi) {
    return azimuth_sectors_invert(self.sectors, wi);
}

vec2 bisection_unit(vec2 w) { return (1.0 / sqrt(dot(w, w))) * w; }

/// The middle of the interval of azimuths that is left after all steps.
vec2 bisection_invert_area(const AzimuthSector s, float area, bool central) {
    vec2 low = bisection_unit(s.s0);
    vec2 high = bisection_unit(s.s1);
    // The sum of almost opposite vectors would not be accurate.
    vec2 across = high - low;
    vec2 middle = bisection_unit(dot(low, high) < 0.0 ? vec2(across.y, -across.x) : low + high);
    for (int k = 0; k < kNusseltBisections; ++k) {
        bool beyond = azimuth_sector_area_to(s, middle, central) <= area;
        low = beyond ? middle : low;
        high = beyond ? high : middle;
        middle = bisection_unit(low + high);
    }
    return middle;
}

/// \param u in [0, 1)^2; x selects the azimuth, y the inclination.
/// \returns the direction alone; polygon_projected_solid_angle_bisection_sample() adds density and point.
vec3 polygon_projected_solid_angle_bisection_direction(const PolygonProjectedSolidAngleBisection self, vec2 u) {
    float area = u.x * self.sectors.total;
    AzimuthSector s = azimuth_sectors_select(self.sectors, area);
    vec2 w = bisection_invert_area(s, area, self.sectors.central);
    return azimuth_sectors_direction(self.sectors, s, w, u.y);
}

/// \param u in [0, 1)^2.
LightSample polygon_projected_solid_angle_bisection_sample(const PolygonProjectedSolidAngleBisection self, vec2 u) {
    return azimuth_sectors_complete(self.sectors, polygon_projected_solid_angle_bisection_direction(self, u));
}

#endif
