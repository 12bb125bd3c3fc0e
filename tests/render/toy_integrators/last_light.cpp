// Direct light with another light selector: it takes the last light of the scene alone.

#include "render_cpu/kernel/direct_light.h"
#include "render_cpu/kernel/tile.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

struct LastLightAlone {
    template <class Visit>
    void operator()(const render_cpu::KernelScene& scene, const Visit& visit) const noexcept {
        if (scene.light_count > 0) visit(scene.light_count - 1);
    }
};

class LastLight {
public:
    explicit LastLight(const render_cpu::RenderJob&) noexcept {}

    Vector radiance(const CameraPacket& packet, const Rays& rays) const noexcept {
        return emitted_and_direct_light(packet, rays, LastLightAlone());
    }
};

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

RenderTile toy_last_light(LaneCount<kernel::kLanes>) { return &kernel::render_tile<kernel::LastLight>; }

} // namespace nusselt::render_cpu
