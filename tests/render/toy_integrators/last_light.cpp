// Direct light with another light selector: it takes the last light of the scene alone.

#include "render_cpu/kernel/direct_light.h"
#include "render_cpu/kernel/tile.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

struct LastLightAlone {
    template <class Visit>
    void operator()(const render_cpu::KernelScene& scene, const Visit& visit) const noexcept {
        const std::int32_t count = scene.polygon_light_count + scene.line_light_count;
        if (count > 0) visit(count - 1);
    }
};

class LastLight {
public:
    explicit LastLight(const render_cpu::RenderJob& job) noexcept : functions_(light_functions(job)) {}

    Vector radiance(const CameraPacket& packet, const Rays& rays) const noexcept {
        return emitted_and_direct_light(packet, rays, functions_, LastLightAlone());
    }

private:
    LightFunctions functions_;
};

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

RenderTile toy_last_light(LaneCount<kernel::kLanes>) { return &kernel::render_tile<kernel::LastLight>; }

} // namespace nusselt::render_cpu
