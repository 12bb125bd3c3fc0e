#ifndef NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_ARVO_GLSL
#define NUSSELT_RELATED_POLYGON_PROJECTED_SOLID_ANGLE_ARVO_GLSL
// Follows include/nusselt/related/polygon_projected_solid_angle_arvo.h @ da14f38eedc4
/// A published method, to compare with: projected solid angle sampling by azimuth and inclination, inverted by Newton's
/// method from a cubic polynomial. J. Arvo 2001, Stratified Sampling of 2-Manifolds, SIGGRAPH course State of the Art in
/// Monte Carlo Ray Tracing for Realistic Image Synthesis. Use polygon_projected_solid_angle.glsl instead: three steps do not
/// always suffice. Twin of include/nusselt/related/polygon_projected_solid_angle_arvo.h, which lists deviations and known
/// failures.
///
/// Measure and space as polygon_projected_solid_angle.glsl.

#include "../related/azimuth_sectors.glsl"

const int kNusseltNewtonSteps = 3;

struct PolygonProjectedSolidAngleArvo {
    AzimuthSectors sectors;
    vec3 cubic[kNusseltSlots];  ///< coefficients of powers 1 to 3, from shares of the area of a sector to angles
    float sweep[kNusseltSlots]; ///< the angles of sectors
};

/// The direction at an angle from the unit vector `begin`.
vec2 arvo_turned(vec2 begin, const SinCos angle) { return angle.cosine * begin + angle.sine * vec2(-begin.y, begin.x); }

vec2 arvo_unit(vec2 w) { return (1.0 / sqrt(dot(w, w))) * w; }

/// Lagrange's polynomial through the shares of the area at four azimuths.
void arvo_prepare_start(inout PolygonProjectedSolidAngleArvo self, int k) {
    AzimuthSector s = self.sectors.sector[k];
    bool central = self.sectors.central;
    float sweep = peters_atan2_positive(peters_det(s.s0, s.s1), dot(s.s0, s.s1));
    float third = 1.0 / 3.0 * sweep;
    SinCos turn = peters_sincos_half_turn(third);
    vec2 w1 = arvo_turned(arvo_unit(s.s0), turn);
    float x1 = azimuth_sector_area_to(s, w1, central) / s.area;
    float x2 = azimuth_sector_area_to(s, arvo_turned(w1, turn), central) / s.area;

    // Newton's divided differences; the first node is the origin.
    float slope_01 = third / x1;
    float slope_12 = third / (x2 - x1);
    float slope_23 = third / (1.0 - x2);
    float bend_02 = (slope_12 - slope_01) / x2;
    float bend_13 = (slope_23 - slope_12) / (1.0 - x1);
    float cubic = bend_13 - bend_02;
    vec3 polynomial = vec3(slope_01 - x1 * (bend_02 - x2 * cubic), bend_02 - (x1 + x2) * cubic, cubic);
    // Without order among rounded areas, the area counts as uniform.
    bool ordered = x1 > 0.0 && x2 > x1 && x2 < 1.0;
    self.cubic[k] = ordered ? polynomial : vec3(sweep, 0.0, 0.0);
    self.sweep[k] = sweep;
}

/// \param light in shading space, either winding [m].
PolygonProjectedSolidAngleArvo polygon_projected_solid_angle_arvo_prepare(const ConvexPolygon light) {
    PolygonProjectedSolidAngleArvo self;
    self.sectors = azimuth_sectors_prepare(light);
    NUSSELT_UNROLL for (int k = 0; k < kNusseltSlots; ++k) {
        self.cubic[k] = vec3(0.0);
        self.sweep[k] = 0.0;
        if (self.sectors.sector[k].area > 0.0) arvo_prepare_start(self, k);
    }
    return self;
}

/// \copydoc azimuth_sectors_measure
float polygon_projected_solid_angle_arvo_measure(const PolygonProjectedSolidAngleArvo self) {
    return azimuth_sectors_measure(self.sectors);
}

/// \copydoc azimuth_sectors_pdf
float polygon_projected_solid_angle_arvo_pdf(const PolygonProjectedSolidAngleArvo self, vec3 wi) {
    return azimuth_sectors_pdf(self.sectors, wi);
}

/// \copydoc azimuth_sectors_invert
vec2 polygon_projected_solid_angle_arvo_invert(const PolygonProjectedSolidAngleArvo self, vec3 wi) {
    return azimuth_sectors_invert(self.sectors, wi);
}

/// The azimuth up to which a sector has an area.
vec2 arvo_invert_area(const AzimuthSector s, vec3 cubic, float sweep, float area, bool central) {
    vec2 begin = arvo_unit(s.s0);
    float share = area / s.area;
    // Where the polynomial leaves the sector, the angle starts in proportion to the area.
    float polynomial = share * (cubic.x + share * (cubic.y + share * cubic.z));
    bool inside = polynomial > 0.0 && polynomial < sweep;
    float angle = inside ? polynomial : share * sweep;
    vec2 w = arvo_turned(begin, peters_sincos_half_turn(angle));
    for (int k = 0; k < kNusseltNewtonSteps; ++k) {
        // The derivative of the area is half of the difference between squared radii.
        float density = 1.0 / peters_form(s.outer, w);
        if (!central) density = density - 1.0 / peters_form(s.inner, w);
        float excess = azimuth_sector_area_to(s, w, central) - area;
        bool rises = density > 0.0;
        float next = angle - 2.0 * excess / (rises ? density : 1.0);
        // A step that leaves the sector goes half of the way to its end: at the end itself, the density may vanish.
        float end = excess > 0.0 ? 0.0 : sweep;
        bool leaves = next < 0.0 || next > sweep || (excess != 0.0 && !rises);
        angle = leaves ? 0.5 * (angle + end) : next;
        w = arvo_turned(begin, peters_sincos_half_turn(angle));
    }
    return w;
}

/// \param u in [0, 1)^2; x selects the azimuth, y the inclination.
/// \returns the direction alone; polygon_projected_solid_angle_arvo_sample() adds density and point.
vec3 polygon_projected_solid_angle_arvo_direction(PolygonProjectedSolidAngleArvo self, vec2 u) {
    float area = u.x * self.sectors.total;
    AzimuthSector s = self.sectors.sector[0];
    vec3 cubic = self.cubic[0];
    float sweep = self.sweep[0];
    NUSSELT_UNROLL for (int k = 1; k < kNusseltSlots; ++k) {
        if (self.sectors.sector[k].area > 0.0 && area >= s.area) {
            area = area - s.area;
            s = self.sectors.sector[k];
            cubic = self.cubic[k];
            sweep = self.sweep[k];
        }
    }
    vec2 w = arvo_invert_area(s, cubic, sweep, area, self.sectors.central);
    return azimuth_sectors_direction(self.sectors, s, w, u.y);
}

/// \param u in [0, 1)^2.
LightSample polygon_projected_solid_angle_arvo_sample(const PolygonProjectedSolidAngleArvo self, vec2 u) {
    return azimuth_sectors_complete(self.sectors, polygon_projected_solid_angle_arvo_direction(self, u));
}

#endif
