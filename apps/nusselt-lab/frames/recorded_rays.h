#pragma once
/// The rays of a rendering, to measure what Embree alone takes for them.

#include "render_cpu/renderer.h"
#include "visibility/ray_recorder.h"

#include <tbb/task_arena.h>

#include <cstdint>
#include <memory>

namespace nusselt::app {

class RecordedRays {
public:
    virtual ~RecordedRays() = default;

    /// Traces all rays again with all threads of the arena.
    /// \returns times of Embree's functions alone, sums over the threads
    virtual visibility::ReplaySeconds replay(tbb::task_arena& arena) const = 0;

    std::uint64_t primary_count = 0;
    std::uint64_t shadow_count = 0;
};

/// Renders and records the rays.
/// \param renderer must outlive the result
std::unique_ptr<RecordedRays> record_rays(const render_cpu::Renderer& renderer,
                                          const render::RenderSettings& settings, base::Isa isa);

} // namespace nusselt::app
