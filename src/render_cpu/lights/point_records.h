#pragma once
/// Point lights in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/kernel.h"
#include "render_cpu/lights/luminaire_table.h"

#include <memory>

namespace nusselt::render_cpu {

struct PointRecord {
    scene::Float3 position;
    scene::Float3 x_axis, y_axis, z_axis;
    scene::Float3 intensity;
    scene::PointDistribution distribution;
    float cone_end;           ///< scene::ConeFalloff::end
    float inverse_cone_width; ///< 1 / scene::ConeFalloff::width, or a large number
    scene::Float2 half_extent;
    LuminaireTable luminaire; ///< of the share of the intensity; without angles for none
    std::int32_t texture;     ///< index into KernelScene::textures, -1 for none
};

/// Makes an array of PointRecord, see LightKernel.
std::shared_ptr<const void> make_point_records(const scene::Scene& scene, const scene::LightList& list);

// In kernel/lights/point.cpp.
LightCode point_code(LaneCount<4>), point_code(LaneCount<8>), point_code(LaneCount<16>);

} // namespace nusselt::render_cpu
