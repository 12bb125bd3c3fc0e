#ifndef NUSSELT_PASSES_CELLS_POLYGON_CELL_SAMPLES_GLSL
#define NUSSELT_PASSES_CELLS_POLYGON_CELL_SAMPLES_GLSL
/// Samples of polygonal lights in proportion to their image times a measure.

#include "passes/cells/polygon_cells.glsl"
#include "passes/lights/techniques.glsl"

/// Whether images decide where samples are; otherwise, polygons are sampled as if they were uniform. Scenes without
/// images do not compile cells, which are more than half of the code for polygons.
const bool kHasCellSamples =
    kHasTexturedPolygons && kEmissionSampling == kEmissionSamplingProduct && kIsProjected && !kHasBrdfSamples;

const bool kHasCellPairs = kStrategies == kStrategiesDiffuseLtc;

/// The technique of a smooth cell: projected solid angle of the part of the light, or of its image in the space of the lobe.
struct PartTechnique {
    PolygonPart part;
    PolygonProjectedSolidAngle image;
};

PartTechnique part_technique(const PolygonCells cells, int technique, ConvexPolygon polygon) {
    PolygonPart part = whole_part(polygon);
    if (kHasCellPairs && technique == 1) polygon = to_cosine_space(part.polygon, cells.lobe);
    return PartTechnique(part, polygon_projected_solid_angle_prepare(polygon));
}

PolygonLtc on_lobe(const PolygonCells cells, const PartTechnique self) {
    return polygon_ltc_prepare_image(self.part, cells.lobe, self.image);
}

// As textured_polygon_sample() and textured_polygon_ltc_sample(), with one copy of what they share.
TexturedSample cells_sample(const PolygonCells cells, int technique, vec2 u) {
    TexturedView view = cells.diffuse.view;
    float total = cells.diffuse.sums.total;
    CellChoice cell;
    if (kHasCellPairs && technique == 1) {
        view = cells.specular.view;
        total = cells.specular.sums.total;
        cell = cell_sums_choose(cells.specular.sums, u);
    } else {
        cell = cell_sums_choose(cells.diffuse.sums, u);
    }
    if (!(total > 0.0)) return no_textured_sample();
    TexturedSpot spot = textured_view_spot_of(view, cell);
    if (!spot.is_smooth) return textured_view_busy_sample(view, spot);
    PartTechnique part = part_technique(cells, technique, polygon_in(view.plane, spot.part));
    LightSample s = polygon_projected_solid_angle_sample(part.image, spot.cell.u);
    if (kHasCellPairs && technique == 1) s = polygon_ltc_sample_image(on_lobe(cells, part), s);
    return textured_view_smooth_sample(view, spot, s);
}

// As textured_polygon_density() and textured_polygon_ltc_density().
float cells_pdf(const PolygonCells cells, int technique, const TexturedSample s) {
    TexturedView view = cells.diffuse.view;
    float total = cells.diffuse.sums.total;
    CellChoice cell;
    if (technique == 1) {
        view = cells.specular.view;
        total = cells.specular.sums.total;
        cell = cell_sums_at(cells.specular.sums, s.at);
    } else {
        cell = cell_sums_at(cells.diffuse.sums, s.at);
    }
    if (!(total > 0.0) || !(cell.probability > 0.0)) return 0.0;
    TexturedSpot spot = textured_view_spot_at(view, cell, s.at);
    if (!spot.is_smooth) return textured_view_busy_density(view, spot, s.wi, s.at);
    PartTechnique part = part_technique(cells, technique, polygon_in(view.plane, spot.part));
    float pdf = polygon_projected_solid_angle_pdf(part.image, s.wi);
    if (technique == 1) pdf = polygon_ltc_pdf(on_lobe(cells, part), s.wi);
    return spot.cell.probability * pdf;
}

vec3 cells_radiance(const PolygonCells cells, vec2 at) { return texture_radiance(cells.texture_number, at); }
vec3 cells_point(const PolygonCells cells, const TexturedSample s) { return s.p; }

#define CELLS PolygonCells
#include "passes/cells/add_cells.glsl"
#undef CELLS

void add_polygon(inout Estimate estimate, const LocalPolygon light) {
    if (!kHasCellSamples || light.texture_number < 0) {
        if (kHasPolygons || kHasProfiledPolygons || kHasPortals || !kHasCellSamples) add_light(estimate, light);
        return;
    }
    if (!light.role.is_lit) return;
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = kHasCellPairs && glossy_surface_is_glossy(glossy);
    add_cells(estimate, light.role.number, prepare_cells(light, glossy.lobe, is_paired), is_paired, vec3(1.0));
}

#endif
