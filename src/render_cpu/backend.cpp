#include "render_cpu/backend.h"

#include "render_cpu/renderer.h"

#include <string>

namespace nusselt::render_cpu {

namespace {

class CpuScene final : public render::PreparedScene {
public:
    CpuScene(const scene::Scene& scene, base::Isa isa, int threads) : isa_(isa), renderer_(scene, threads) {}

    render::RenderStatistics render_into(render::Frame& frame, const render::RenderSettings& settings,
                                         const render::RenderMonitor& monitor) override {
        return renderer_.render_into(frame, settings, isa_, renderer_.visibility().tracer(), monitor);
    }

private:
    base::Isa isa_;
    Renderer renderer_;
};

} // namespace

CpuBackend::CpuBackend(base::Isa isa, int threads) : isa_(isa), threads_(checked_thread_count(threads)) {}

std::optional<std::string> CpuBackend::why_unsupported(const scene::Scene&,
                                                       const render::RenderSettings&) const {
    return std::nullopt;
}

std::optional<std::string> CpuBackend::why_unsupported(const render::RenderSettings&) const {
    return std::nullopt;
}

std::size_t CpuBackend::layer_sum_bytes(const scene::Scene& scene,
                                        const render::RenderSettings& settings) const {
    return render_cpu::layer_sum_bytes(scene, settings, isa_, threads_);
}

std::unique_ptr<render::PreparedScene> CpuBackend::prepare(const scene::Scene& scene) const {
    return std::make_unique<CpuScene>(scene, isa_, threads_);
}

image::Metadata CpuBackend::metadata() const { return {{"isa", std::string(name_of(isa_))}}; }

render::NamedTexts CpuBackend::properties() const { return {{"isa", std::string(name_of(isa_))}}; }

render::TimeReport CpuBackend::times(const render::RenderStatistics& statistics) const {
    return {{{"bvh", statistics.build_seconds}},
            "thread_seconds",
            {{"primary_rays", statistics.primary_seconds},
             {"shading", statistics.shading_seconds},
             {"shadow_rays", statistics.shadow_seconds}}};
}

} // namespace nusselt::render_cpu
