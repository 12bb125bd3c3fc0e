#include "recorded_rays.h"

#include "base/flush_denormals.h"
#include "base/isa.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <functional>
#include <vector>

namespace nusselt::app {

namespace {

/// Packets of N rays.
template <int N>
class PacketsOfRays : public RecordedRays {
public:
    PacketsOfRays(const render_cpu::Renderer& renderer, const render::RenderSettings& settings, base::Isa isa)
        : recorder_(renderer.visibility()) {
        const render::RenderStatistics work = renderer.render(settings, isa, recorder_.tracer()).statistics;
        primary_count = work.primary_rays;
        shadow_count = work.shadow_rays;
    }

    visibility::ReplaySeconds replay(tbb::task_arena& arena) const override {
        const std::vector<const visibility::RayBatch<N>*> batches = recorder_.batches();
        return arena.execute([&] {
            return tbb::parallel_reduce(
                tbb::blocked_range<std::size_t>(0, batches.size()), visibility::ReplaySeconds(),
                [&](const auto& range, visibility::ReplaySeconds sum) {
                    const base::FlushDenormals flush_denormals;
                    for (std::size_t i = range.begin(); i < range.end(); ++i)
                        sum = sum + recorder_.replay(*batches[i]);
                    return sum;
                },
                std::plus<>());
        });
    }

private:
    visibility::RayRecorder<N> recorder_;
};

} // namespace

std::unique_ptr<RecordedRays> record_rays(const render_cpu::Renderer& renderer,
                                          const render::RenderSettings& settings, base::Isa isa) {
    return base::dispatch(isa, [&]<base::Isa chosen>() -> std::unique_ptr<RecordedRays> {
        constexpr int kLanes = chosen == base::Isa::sse42 ? 4 : chosen == base::Isa::avx2 ? 8 : 16;
        return std::make_unique<PacketsOfRays<kLanes>>(renderer, settings, isa);
    });
}

} // namespace nusselt::app
