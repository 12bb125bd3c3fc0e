#include "render_vulkan/unsupported.h"

#include "interface/lights.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace nusselt::render_vulkan {

namespace {

using LightShapes = decltype(SceneKinds::lights);

std::size_t index_of(int constant) {
    return static_cast<std::size_t>(constant - interface::kFirstLightConstant);
}

template <class Light>
void mark_shapes(const scene::Lights& lights, LightShapes& shapes) {
    for (const Light& light : lights.of<Light>()) shapes.at(index_of(constant_of(light))) = true;
}

/// Of the kinds of lights that decide what is supported.
LightShapes shapes_of(const scene::Lights& lights) {
    LightShapes shapes = {};
    mark_shapes<scene::PolygonLight>(lights, shapes);
    mark_shapes<scene::LineLight>(lights, shapes);
    mark_shapes<scene::EnvironmentLight>(lights, shapes);
    return shapes;
}

std::optional<std::string> why_unsupported_with(const LightShapes& shapes,
                                                const render::RenderSettings& settings) {
    // Their integrals take cells that shaders do not have.
    const auto has = [&](int constant) { return shapes.at(index_of(constant)); };
    const bool has_profiles = has(interface::kProfiledPolygonsConstant) ||
                              has(interface::kProfiledLinesConstant) ||
                              has(interface::kProfiledTubesConstant);
    if (settings.technique == render::Technique::ltc_analytic && has_profiles)
        return "--technique ltc_analytic is not supported on GPUs for lights with a profile, a spread or a "
               "honeycomb";
    if (settings.technique == render::Technique::ltc_analytic && has(interface::kMappedPortalsConstant))
        return "--technique ltc_analytic is not supported on GPUs for portals of environments with a map";
    return render_vulkan::why_unsupported(settings);
}

template <class Light>
std::ptrdiff_t count_of(int constant, const scene::Lights& lights) {
    const auto& of_kind = lights.of<Light>();
    return std::count_if(of_kind.begin(), of_kind.end(),
                         [&](const Light& light) { return constant_of(light) == constant; });
}

/// Whether the CPU would sample profiles of lines in proportion to their radiance: takes_products() of its kernel.
bool asks_for_products(const render::RenderSettings& settings) {
    using render::Technique;
    return settings.emission_sampling == render::EmissionSampling::product &&
           (settings.technique == Technique::projected_solid_angle ||
            settings.technique == Technique::projected_solid_angle_biased);
}

/// The same for profiles of polygons and for portals: takes_windowed_products(), for the strategies that have products.
bool asks_for_windowed_products(const render::RenderSettings& settings) {
    const bool is_optimal =
        settings.strategies == render::Strategies::diffuse_ltc && settings.mis == render::Mis::optimal;
    return asks_for_products(settings) && !is_optimal && !samples_visible_normals(settings.strategies);
}

/// \param lights that are sampled by their measure, although settings ask for products
std::string sampling_warning(std::string_view lights, std::ptrdiff_t count) {
    return std::string(lights) + " (" + std::to_string(count) + ") are sampled as with --emission-sampling " +
           std::string(name_of(render::EmissionSampling::measure)) + ": GPUs have no other samples of them";
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
    return why_unsupported_with(kinds.lights, settings);
}

std::optional<std::string> why_unsupported(const scene::Scene& scene,
                                           const render::RenderSettings& settings) {
    if (auto reason = why_unsupported(scene.lights)) return reason;
    return why_unsupported_with(shapes_of(scene.lights), settings);
}

std::vector<std::string> sampling_warnings(const scene::Scene& scene,
                                           const render::RenderSettings& settings) {
    std::vector<std::string> warnings;
    const auto add = [&](std::string_view lights, std::ptrdiff_t count) {
        if (count > 0) warnings.push_back(sampling_warning(lights, count));
    };
    if (asks_for_products(settings)) // tubes have none on the CPU either
        add("linear lights and strips with a profile or a spread",
            count_of<scene::LineLight>(interface::kProfiledLinesConstant, scene.lights));
    if (asks_for_windowed_products(settings)) {
        add("polygons with a profile, a spread or a honeycomb",
            count_of<scene::PolygonLight>(interface::kProfiledPolygonsConstant, scene.lights));
        add("portals of environments with a map",
            count_of<scene::EnvironmentLight>(interface::kMappedPortalsConstant, scene.lights));
    }
    return warnings;
}

} // namespace nusselt::render_vulkan
