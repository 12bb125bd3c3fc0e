#pragma once
/// The input of integrators: one camera ray for each pixel of a packet.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/layers.h"
#include "render_cpu/kernel/random.h"
#include "render_cpu/kernel/stop_request.h"
#include "render_cpu/kernel/tick_timer.h"

#include <limits>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

struct CameraPacket {
    const render_cpu::RenderJob& job;
    const PixelBlock& block;
    std::uint32_t camera_ray; ///< its number, below job.camera_rays
    LayerSums* layers;        ///< null if the job has none
    void* line_memory;        ///< see TileMemory
    const StopRequest& stop;  ///< once it is urgent, the radiance has no meaning
    render_cpu::TileStatistics& statistics;
};

/// One ray per lane.
struct Rays {
    std::uint32_t active; ///< a bit for each lane that has one
    Vector origin;        ///< [m]
    Vector direction;     ///< of any length
};

/// Finds what the rays hit first.
inline visibility::HitPacket<kLanes> trace(const CameraPacket& packet, const Rays& rays) noexcept {
    visibility::RayPacket<kLanes> traced;
    rays.origin.x.store(traced.origin[0]);
    rays.origin.y.store(traced.origin[1]);
    rays.origin.z.store(traced.origin[2]);
    rays.direction.x.store(traced.direction[0]);
    rays.direction.y.store(traced.direction[1]);
    rays.direction.z.store(traced.direction[2]);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Real(kInfinity).store(traced.t_far);
    visibility::HitPacket<kLanes> hits;
    const visibility::PacketTracer<kLanes>& tracer = packet.job.tracer;
    packet.statistics.primary_rays += static_cast<std::uint64_t>(__builtin_popcount(rays.active));
    const TickTimer timer(packet.statistics.primary_ticks);
    tracer.intersect(packet.job.tracer.context, rays.active, traced, hits);
    return hits;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
