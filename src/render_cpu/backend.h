#pragma once
/// The backend that renders on the processor.

#include "base/isa.h"
#include "render/backend.h"

namespace nusselt::render_cpu {

class CpuBackend final : public render::Backend {
public:
    /// \param isa     supported by the processor
    /// \param threads at least 1
    /// \throws std::runtime_error see base::check_threads()
    CpuBackend(base::Isa isa, int threads);

    std::string_view name() const override { return "cpu"; }
    std::optional<std::string> why_unsupported(const render::RenderSettings& settings) const override;
    std::optional<std::string> why_unsupported(const scene::Scene& scene,
                                               const render::RenderSettings& settings) const override;
    std::size_t layer_sum_bytes(const scene::Scene& scene,
                                const render::RenderSettings& settings) const override;
    std::unique_ptr<render::PreparedScene> prepare(const scene::Scene& scene) const override;
    image::Metadata metadata() const override;
    render::NamedTexts properties() const override;
    render::TimeReport times(const render::RenderStatistics& statistics) const override;

private:
    base::Isa isa_;
    int threads_;
};

} // namespace nusselt::render_cpu
