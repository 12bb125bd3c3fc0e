#ifndef NUSSELT_PASSES_CELLS_LINE_CELL_SAMPLES_GLSL
#define NUSSELT_PASSES_CELLS_LINE_CELL_SAMPLES_GLSL
/// Samples of lines and tubes in proportion to their radiance times a measure, as in
/// src/render_cpu/kernel/lights/textured_lines.cpp.

#include "nusselt/line_emission/textured_tube.glsl"
#include "nusselt/line_emission/textured_tube_ltc.glsl"
#include "passes/cells/line_cells.glsl"

// As textured_line_sample() and textured_line_ltc_sample(), with one copy of what they share.
TexturedSample cells_sample(LineLightCells cells, int technique, vec2 u) {
    LineCells self = cells.of_technique[technique];
    if (!(self.total > 0.0)) return no_textured_sample();
    LineSpot spot = line_cells_spot_of(self, u.x);
    if (kStrategies == kStrategiesDiffuseLtc && technique == 1) {
        LineLtc of_cell = line_clipped_ltc_prepare(spot.cell.part, cells.lobe);
        return line_cells_sample(self, spot, line_ltc_sample(of_cell, spot.x), line_ltc_measure(of_cell));
    }
    LineProjectedSolidAngle of_cell = line_projected_solid_angle_prepare(spot.cell.part);
    return line_cells_sample(self, spot, line_projected_solid_angle_sample(of_cell, spot.x),
                             line_projected_solid_angle_measure(of_cell));
}

// As textured_line_density() and textured_line_ltc_density().
float cells_pdf(LineLightCells cells, int technique, const TexturedSample s) {
    LineCells self = cells.of_technique[technique];
    LineCell cell = line_cells_cell(self, line_cells_cell_at(self, s.at.x));
    if (!(self.total > 0.0) || s.wi.z < 0.0) return 0.0;
    if (technique == 1) {
        LineLtc of_cell = line_clipped_ltc_prepare(cell.part, cells.lobe);
        return line_cells_density(self, cell, line_ltc_invert(of_cell, s.wi),
                                  line_ltc_measure(of_cell) * line_ltc_pdf(of_cell, s.wi));
    }
    LineProjectedSolidAngle of_cell = line_projected_solid_angle_prepare(cell.part);
    return line_cells_density(self, cell, line_projected_solid_angle_invert(of_cell, s.wi),
                              line_projected_solid_angle_measure(of_cell) *
                                  line_projected_solid_angle_pdf(of_cell, s.wi));
}

vec3 cells_radiance(const LineLightCells cells, vec2 at) {
    return line_profile_lookup(cells.of_technique[0].profile, at.x);
}
vec3 cells_point(const LineLightCells cells, const TexturedSample s) { return s.p; }

#define CELLS LineLightCells
#include "passes/cells/add_cells.glsl"
#undef CELLS

/// A tube whose radiance varies along it, for techniques that know its profile.
struct ProfiledTube {
    Cylinder tube;
    uint profile;
};
struct LocalProfiledTube {
    ProfiledTube shape; ///< in shading space
    LocalTube light;
    LightRole role;
};

bool has_pair(const ProfiledTube light, const GlossySurface surface) { return is_line_paired(surface); }

/// The techniques for radiance times the cosine at the surface and times a lobe.
struct ProfiledTubeTechniques {
    TexturedTube projected;
    TexturedTubeLtc ltc;
};

ProfiledTubeTechniques prepare_techniques(const ProfiledTube light, const GlossySurface surface, bool is_paired) {
    ProfiledTubeTechniques self;
    self.projected = textured_tube_prepare(light.tube, light.profile);
    if (is_paired) self.ltc = textured_tube_ltc_prepare(light.tube, light.profile, surface.lobe);
    return self;
}

LightSample techniques_sample(const ProfiledTubeTechniques self, int technique, vec2 u) {
    if (technique == 1) return textured_tube_ltc_sample(self.ltc, u);
    return textured_tube_sample(self.projected, u);
}

vec2 techniques_pdf(const ProfiledTubeTechniques self, vec3 wi) {
    return vec2(textured_tube_pdf(self.projected, wi), textured_tube_ltc_pdf(self.ltc, wi));
}

vec2 techniques_integrals(const ProfiledTubeTechniques self) {
    return vec2((1.0 / kNusseltPi) * textured_tube_measure(self.projected), textured_tube_ltc_measure(self.ltc));
}

void modulate(const LocalProfiledTube light, inout DirectLightSample s) { modulate(light.light, s); }

#define LOCAL_LIGHT LocalProfiledTube
#define TECHNIQUES ProfiledTubeTechniques
#include "passes/lights/add_light.glsl"
#undef LOCAL_LIGHT
#undef TECHNIQUES

void add_line(inout Estimate estimate, const LocalLine light) {
    if (!kHasLineCells || !varies(light.radiance)) {
        add_by_measure(estimate, light);
        return;
    }
    if (kHasTexturedTubes && is_tube(light)) {
        LocalTube tube = tube_of(light);
        add_light(estimate, LocalProfiledTube(ProfiledTube(tube.shape, light.radiance.profile), tube, light.role));
        return;
    }
    if (!kHasTexturedLines || !light.role.is_lit) return;
    GlossySurface glossy = estimate.reflection.glossy;
    bool is_paired = is_line_paired(glossy);
    add_cells(estimate, light.role.number, prepare_cells(light, glossy.lobe, is_paired), is_paired, vec3(light.width));
}

#endif
