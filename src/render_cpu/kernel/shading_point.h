#pragma once
/// One shading point of a packet, for packs whose lanes are not shading points but, for example, lines.

#include "render_cpu/kernel/single_lane.h"
#include "render_cpu/kernel/surface.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

struct ShadingPoint {
    GlossySurface<Real, SurfaceBrdf> surface; ///< the same in all lanes
    Frame<Real> frame;                        ///< the same in all lanes
    Vec3<float> position;                     ///< world space [m]
    Vec3<float> geometric_normal;             ///< see Surface
    Vec3<float> apex;                         ///< where shadow rays start [m]
    bool is_closed_form;                      ///< whether integrals of the BRDF along lines are exact
    int lane;                                 ///< of the packet
};

inline ShadingPoint shading_point(const Surface& surface, int lane) noexcept {
    const auto& glossy = surface.glossy;
    const bool is_frostbite = glossy.brdf.is_frostbite.lane(lane);
    const SurfaceBrdf brdf{broadcast_lane(glossy.brdf.lambert, lane),
                           broadcast_lane(glossy.brdf.frostbite, lane),
                           broadcast_lane(glossy.brdf.phong, lane), LaneMask(is_frostbite),
                           LaneMask(glossy.brdf.is_phong.lane(lane))};
    const auto position = single_lane<Vec3<float>>(surface.position, lane);
    const auto normal = single_lane<Vec3<float>>(surface.geometric_normal, lane);
    const auto offset = single_lane<float>(surface.offset, lane);
    return {{broadcast_lane(glossy.wo, lane), broadcast_lane(glossy.alpha, lane), brdf,
             broadcast_lane(glossy.lobe, lane), broadcast_lane(glossy.diffuse_albedo, lane),
             broadcast_lane(glossy.specular_albedo, lane)},
            broadcast_lane(surface.frame, lane),
            position,
            normal,
            position + offset * normal,
            !is_frostbite,
            lane};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
