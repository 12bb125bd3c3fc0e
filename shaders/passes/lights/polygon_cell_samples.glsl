#ifndef NUSSELT_PASSES_LIGHTS_POLYGON_CELL_SAMPLES_GLSL
#define NUSSELT_PASSES_LIGHTS_POLYGON_CELL_SAMPLES_GLSL
/// Samples of polygonal lights in proportion to their image times a measure.

#include "passes/lights/polygon_cells.glsl"
#include "passes/lights/techniques.glsl"

/// Whether images decide where samples are; otherwise, polygons are sampled as if they were uniform.
const bool kHasCellSamples = kEmissionSampling == kEmissionSamplingProduct && kIsProjected && !kHasBrdfSamples;

const bool kHasCellPairs = kStrategies == kStrategiesDiffuseLtc;

// As textured_polygon_sample() and textured_polygon_ltc_sample(), with one copy of what they share.
TexturedSample cells_sample(PolygonCells cells, int technique, vec2 u) {
    TexturedCells self = cells.of_technique[technique];
    if (!(self.sums.total > 0.0)) return no_textured_sample();
    TexturedSpot spot = textured_cells_spot_of(self, u);
    if (!spot.is_smooth) return textured_view_busy_sample(self.view, spot);
    ConvexPolygon part = polygon_in(self.view.plane, spot.part);
    LightSample s;
    if (kHasCellPairs && technique == 1)
        s = polygon_ltc_sample(polygon_ltc_prepare(part, cells.lobe), spot.cell.u);
    else
        s = polygon_projected_solid_angle_sample(polygon_projected_solid_angle_prepare(part), spot.cell.u);
    return textured_view_smooth_sample(self.view, spot, s);
}

// As textured_polygon_density() and textured_polygon_ltc_density().
float cells_pdf(PolygonCells cells, int technique, TexturedSample s) {
    TexturedCells self = cells.of_technique[technique];
    TexturedSpot spot = textured_cells_spot_at(self, s.at);
    if (!(self.sums.total > 0.0) || !(spot.cell.probability > 0.0)) return 0.0;
    if (!spot.is_smooth) return textured_view_busy_density(self.view, spot, s.wi, s.at);
    ConvexPolygon part = polygon_in(self.view.plane, spot.part);
    if (technique == 1) return spot.cell.probability * polygon_ltc_pdf(polygon_ltc_prepare(part, cells.lobe), s.wi);
    return spot.cell.probability *
           polygon_projected_solid_angle_pdf(polygon_projected_solid_angle_prepare(part), s.wi);
}

vec3 cells_radiance(PolygonCells cells, vec2 at) { return texture_radiance(cells.texture_number, at); }
vec3 cells_point(PolygonCells cells, TexturedSample s) { return s.p; }

#define CELLS PolygonCells
#include "passes/lights/add_cells.glsl"
#undef CELLS

void add_polygon(inout Estimate estimate, LocalPolygon light) {
    if (!kHasCellSamples || light.texture_number < 0) {
        if (kHasPolygons || kHasProfiledPolygons || !kHasCellSamples) add_light(estimate, light);
        return;
    }
    if (!light.role.is_lit) return;
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = kHasCellPairs && glossy_surface_is_glossy(glossy);
    add_cells(estimate, light.role.number, prepare_cells(light, glossy.lobe, is_paired), is_paired);
}

#endif
