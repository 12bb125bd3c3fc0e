#include "render/backend.h"

#include <stdexcept>

namespace nusselt::render {

RenderResult render(const Backend& backend, const scene::Scene& scene, const RenderSettings& settings,
                    const RenderMonitor& monitor) {
    validate(settings);
    if (const auto reason = backend.why_unsupported(scene, settings)) throw std::invalid_argument(*reason);
    Frame frame = make_frame(scene, settings);
    const std::unique_ptr<PreparedScene> prepared = backend.prepare(scene);
    const RenderStatistics statistics = prepared->render_into(frame, settings, monitor);
    return to_result(std::move(frame), statistics);
}

} // namespace nusselt::render
