#pragma once
/// How the light of polygons and lines is estimated, chosen once per tile.

#include "render_cpu/kernel/reflected_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Adds the radiance that a packet of shading points reflects of one light.
/// \param index among the lights of its kind
using AddLight = void (*)(ReflectedLight& reflected, std::int32_t index) noexcept;

struct LightFunctions {
    AddLight add_polygon4; ///< for polygons with up to 4 vertices
    AddLight add_polygon8;
    AddLight add_line; ///< for tubes in the limit of a small radius
    AddLight add_tube;
};

/// All samples come from one technique.
LightFunctions single_technique_functions(render::Technique technique) noexcept;

/// Samples come from one technique for the diffuse and one for the specular component.
LightFunctions paired_technique_functions(const render_cpu::RenderJob& job) noexcept;

/// Without samples and without shadows.
LightFunctions analytic_functions() noexcept;

/// Lines for polygons.
/// \param points for all else
LightFunctions line_functions(const LightFunctions& points) noexcept;

/// Points of lights.
inline LightFunctions point_functions(const render_cpu::RenderJob& job) noexcept {
    if (job.technique == render::Technique::ltc_analytic) return analytic_functions();
    if (job.strategies == render::Strategies::diffuse) return single_technique_functions(job.technique);
    return paired_technique_functions(job);
}

/// \copydoc LightFunctions
inline LightFunctions light_functions(const render_cpu::RenderJob& job) noexcept {
    const LightFunctions points = point_functions(job);
    return job.light_samples == render::LightSamples::lines ? line_functions(points) : points;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
