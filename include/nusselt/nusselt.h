#pragma once
/// All techniques, with the BRDFs, random numbers and descriptions of light that they are used with. Packs of SIMD lanes
/// are an extra, as is the splitting of concave lights: include <nusselt/simd/pack.h> or
/// <nusselt/geometry/split_convex.h> as well.

#include <nusselt/bsdf/frostbite.h>
#include <nusselt/bsdf/ggx_visible_normals.h>
#include <nusselt/bsdf/lambert.h>
#include <nusselt/bsdf/phong.h>
#include <nusselt/cones/cone_shading.h>
#include <nusselt/emission/environment_map_words.h>
#include <nusselt/emission/latitude_longitude.h>
#include <nusselt/emission/profile_radiance.h>
#include <nusselt/emission/rectified_table.h>
#include <nusselt/emission/spread.h>
#include <nusselt/emission/textured_light_words.h>
#include <nusselt/emission/window_variation.h>
#include <nusselt/emission/windowed_light_words.h>
#include <nusselt/estimate/backward_error.h>
#include <nusselt/estimate/direct_light.h>
#include <nusselt/estimate/line_light.h>
#include <nusselt/estimate/reference_integrals.h>
#include <nusselt/estimate/reflected_offsets.h>
#include <nusselt/line_emission/line_nodes.h>
#include <nusselt/line_emission/line_profile_words.h>
#include <nusselt/line_emission/visible_part.h>
#include <nusselt/line_samples/partial_shadow.h>
#include <nusselt/line_samples/phong.h>
#include <nusselt/line_samples/shading.h>
#include <nusselt/line_samples/triangle_shadow.h>
#include <nusselt/line_samples/visible_parts.h>
#include <nusselt/ltc/line_shading.h>
#include <nusselt/ltc/polygon_shading.h>
#include <nusselt/ltc/table_file.h>
#include <nusselt/random/light_random.h>

// All techniques, by scripts/check-techniques.py.
#include <nusselt/cones/cone_clipped_ltc.h>
#include <nusselt/cones/cone_clipped_solid_angle.h>
#include <nusselt/cones/cone_ltc.h>
#include <nusselt/cones/cone_projected_solid_angle.h>
#include <nusselt/cones/cone_solid_angle.h>
#include <nusselt/cones/ellipse_area.h>
#include <nusselt/emission/environment_sampling.h>
#include <nusselt/emission/textured_polygon.h>
#include <nusselt/emission/windowed_polygon.h>
#include <nusselt/line_emission/textured_line.h>
#include <nusselt/line_emission/textured_tube.h>
#include <nusselt/sampling/cylinder_area.h>
#include <nusselt/sampling/cylinder_ltc.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/cylinder_solid_angle.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_ltc.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_brdf.h>
#include <nusselt/sampling/polygon_ltc.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>
#include <nusselt/sampling/rectangle_solid_angle.h>
// End of techniques.
