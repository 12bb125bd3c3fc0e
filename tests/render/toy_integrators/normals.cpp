// Shows shading normals: an integrator without any lights.

#include "render_cpu/kernel/camera_packet.h"
#include "render_cpu/kernel/surface.h"
#include "render_cpu/kernel/tile.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

class Normals {
public:
    explicit Normals(const render_cpu::RenderJob&) noexcept {}

    Vector radiance(const CameraPacket& packet, const Rays& rays) const noexcept {
        const visibility::HitPacket<kLanes> hits = trace(packet, rays);
        std::uint32_t on_triangle = 0;
        for (int i = 0; i < kLanes; ++i)
            on_triangle |= static_cast<std::uint32_t>(hits.triangle[i] >= 0) << i;
        const Vector black{Real(0), Real(0), Real(0)};
        if (on_triangle == 0) return black;
        const Surface surface = make_surface(packet.job.scene, hits, LaneMask::from_bits(on_triangle),
                                             -normalize(rays.direction));
        return select(surface.valid, surface.frame.n, black);
    }
};

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

RenderTile toy_normals(LaneCount<kernel::kLanes>) { return &kernel::render_tile<kernel::Normals>; }

} // namespace nusselt::render_cpu
