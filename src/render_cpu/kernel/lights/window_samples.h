#pragma once
/// Where lights whose radiance depends on the direction are worth samples of cells.

#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/single_lane.h"

#include <nusselt/emission/window_variation.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Points from which the radiance of a light varies so little that samples of its measure alone have little noise.
/// \param side(lane) the WindowedLight<float> that a point sees
template <class Side>
LaneMask varies_little(LaneMask lanes, const Surface& surface, const Side& side) noexcept {
    std::uint32_t little = 0;
    const std::uint32_t bits = lanes.bits();
    for (int lane = 0; lane < kLanes; ++lane) {
        if ((bits >> lane & 1u) == 0) continue;
        const WindowedLight<float>& light = side(lane);
        // No frame is needed but that of the light.
        const WindowPlane<float> plane{light.plane.corner - single_lane<Vec3<float>>(surface.position, lane),
                                       light.plane.frame};
        const bool is_even = window_variation(plane, light) <= kLittleVariation<float>;
        little |= static_cast<std::uint32_t>(is_even) << lane;
    }
    return LaneMask::from_bits(little);
}

/// Samples of cells, but of the measure alone for some points.
/// \param even        points from which the light varies little
/// \param add_cells   adds samples to a ReflectedLight
/// \param add_measure the same
template <class AddCells, class AddMeasure>
void add_where_it_varies(ReflectedLight& reflected, LaneMask lit, LaneMask even, const AddCells& add_cells,
                         const AddMeasure& add_measure) noexcept {
    const auto add = [&](LaneMask lanes, const auto& add_samples) {
        if (!any(lanes)) return;
        ReflectedLight part = reflected.with(lanes, reflected.job().samples_per_light);
        add_samples(part);
        reflected.add(part);
    };
    add(lit & !even, add_cells);
    add(lit & even, add_measure);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
