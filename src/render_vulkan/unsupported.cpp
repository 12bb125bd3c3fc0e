#include "render_vulkan/unsupported.h"

#include "interface/lights.h"

#include <algorithm>

namespace nusselt::render_vulkan {

namespace {

/// Lights whose integrals take cells that shaders do not have.
struct LightsWithoutIntegral {
    bool profiles, mapped_portals;
};

LightsWithoutIntegral without_integral(const SceneKinds& kinds) {
    const auto has = [&](int constant) {
        return kinds.lights.at(static_cast<std::size_t>(constant - interface::kFirstLightConstant));
    };
    return {has(interface::kProfiledPolygonsConstant) || has(interface::kProfiledLinesConstant) ||
                has(interface::kProfiledTubesConstant),
            has(interface::kMappedPortalsConstant)};
}

LightsWithoutIntegral without_integral(const scene::Lights& lights) {
    const auto has_profile = [](const auto& light) { return light.profile >= 0; };
    const auto is_mapped_portal = [](const auto& light) { return light.map >= 0 && light.portal.size() > 0; };
    const auto& polygons = lights.of<scene::PolygonLight>();
    const auto& lines = lights.of<scene::LineLight>();
    const auto& environments = lights.of<scene::EnvironmentLight>();
    return {std::any_of(polygons.begin(), polygons.end(), has_profile) ||
                std::any_of(lines.begin(), lines.end(), has_profile),
            std::any_of(environments.begin(), environments.end(), is_mapped_portal)};
}

std::optional<std::string> why_unsupported_with(const LightsWithoutIntegral& lights,
                                                const render::RenderSettings& settings) {
    if (settings.technique == render::Technique::ltc_analytic && lights.profiles)
        return "--technique ltc_analytic is not supported on GPUs for lights with a profile, a spread or a "
               "honeycomb";
    if (settings.technique == render::Technique::ltc_analytic && lights.mapped_portals)
        return "--technique ltc_analytic is not supported on GPUs for portals of environments with a map";
    return render_vulkan::why_unsupported(settings);
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
    return why_unsupported_with(without_integral(kinds), settings);
}

std::optional<std::string> why_unsupported(const scene::Scene& scene,
                                           const render::RenderSettings& settings) {
    if (auto reason = why_unsupported(scene.lights)) return reason;
    return why_unsupported_with(without_integral(scene.lights), settings);
}

} // namespace nusselt::render_vulkan
