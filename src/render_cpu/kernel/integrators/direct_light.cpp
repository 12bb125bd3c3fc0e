#include "render_cpu/kernel/direct_light.h"
#include "render_cpu/kernel/tile.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

/// Light that reaches the camera from lights, directly or by reflection at one surface.
class DirectLightIntegrator {
public:
    explicit DirectLightIntegrator(const render_cpu::RenderJob&) noexcept {}

    Vector radiance(const CameraPacket& packet, const Rays& rays) const noexcept {
        return emitted_and_direct_light(packet, rays, AllLights());
    }
};

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

RenderTile direct_light(LaneCount<kernel::kLanes>) {
    return &kernel::render_tile<kernel::DirectLightIntegrator>;
}

} // namespace nusselt::render_cpu
