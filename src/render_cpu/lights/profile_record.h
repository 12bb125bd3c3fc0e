#pragma once
/// How the radiance of a light depends on the direction, in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/lights/luminaire_table.h"
#include "scene/model/float3.h"

#include <cstdint>

namespace nusselt::render_cpu {

/// A face of the shape that shines as a luminaire, in the frame of its profile.
struct LuminousFaceRecord {
    scene::Float3 normal;
    float area;
};

/// What profiles of all shapes have in common: scene::EmissionProfile and its place.
struct ProfileRecord {
    scene::Float3 x_axis, y_axis, z_axis; ///< of the profile, in world space
    scene::Float3 normal;                 ///< of the light, in world space
    float inverse_slope;                  ///< of the spread, 0 for none
    LuminaireTable luminaire;             ///< without angles for none
    const LuminousFaceRecord* faces;
    std::int32_t face_count;
    scene::Float3 round_axis; ///< of tubes, in the frame of the profile
    float round_area;         ///< 0 for flat shapes
    float least_area;         ///< least visible area
    float inverse_mean;       ///< 1 / scene::ProfiledEmission::mean; 0 for dark lights
};

} // namespace nusselt::render_cpu
