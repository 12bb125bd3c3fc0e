#include "render_vulkan/unsupported.h"

#include "interface/lights.h"

#include <algorithm>

namespace nusselt::render_vulkan {

namespace {

bool has_profiled_polygons(const scene::Scene& scene) {
    const auto& lights = scene.lights.of<scene::PolygonLight>();
    return std::any_of(lights.begin(), lights.end(), [](const auto& light) { return light.profile >= 0; });
}

} // namespace

std::optional<std::string> why_unsupported(const render::RenderSettings& settings) {
    const std::string rest = " not supported on GPUs";
    if (settings.light_samples != render::LightSamples::points)
        return "--light-samples " + std::string(name_of(settings.light_samples)) + " is" + rest;
    if (!settings.layers.empty())
        return "layer " + std::string(name_of(settings.layers.front())) + " is" + rest;
    if (settings.part.count > 1) return "--part is" + rest;
    return std::nullopt;
}

std::optional<std::string> why_unsupported(const SceneKinds& kinds, const render::RenderSettings& settings) {
    const bool has_profiles =
        kinds.lights[interface::kProfiledPolygonsConstant - interface::kFirstLightConstant];
    if (has_profiles && settings.technique == render::Technique::ltc_analytic)
        return "--technique ltc_analytic is not supported on GPUs for polygons with a profile, a spread or a "
               "honeycomb";
    return why_unsupported(settings);
}

std::optional<std::string> why_unsupported(const scene::Scene& scene,
                                           const render::RenderSettings& settings) {
    if (auto reason = why_unsupported(scene.lights)) return reason;
    SceneKinds kinds;
    kinds.lights[interface::kProfiledPolygonsConstant - interface::kFirstLightConstant] =
        has_profiled_polygons(scene);
    return why_unsupported(kinds, settings);
}

} // namespace nusselt::render_vulkan
