#include "render/settings.h"

#include <stdexcept>
#include <string>

namespace nusselt::render {

bool allows(Technique technique, Strategies strategies) {
    switch (strategies) {
    case Strategies::diffuse:
        return true;
    case Strategies::diffuse_ltc:
        return technique == Technique::projected_solid_angle ||
               technique == Technique::projected_solid_angle_biased;
    case Strategies::diffuse_ggx:
    case Strategies::diffuse_ggx_bounded:
        return technique == Technique::projected_solid_angle || technique == Technique::solid_angle;
    }
    return false;
}

bool samples_visible_normals(Strategies strategies) {
    return strategies == Strategies::diffuse_ggx || strategies == Strategies::diffuse_ggx_bounded;
}

bool allows(Strategies strategies, Mis mis) {
    if (!samples_visible_normals(strategies)) return true;
    return mis == Mis::balance || mis == Mis::power || mis == Mis::separate;
}

bool uses_visibility_estimate(Mis mis) { return mis == Mis::clamped_optimal || mis == Mis::optimal; }

bool uses_lobes(const RenderSettings& settings) {
    return settings.technique == Technique::ltc_analytic || settings.strategies != Strategies::diffuse ||
           settings.light_samples == LightSamples::lines;
}

int camera_ray_count(const RenderSettings& settings) {
    if (settings.camera_rays) return *settings.camera_rays;
    return settings.pixel_position == PixelPosition::center ? 1 : settings.samples;
}

bool has_variance(const RenderSettings& settings) { return camera_ray_count(settings) >= 2; }

namespace {

/// Numbers that are no value of their enumeration have no name.
template <class Value>
void check_value(const char* setting, Value value) {
    if (name_of(value).empty())
        throw std::invalid_argument("unknown " + std::string(setting) + ": number " +
                                    std::to_string(static_cast<std::uint32_t>(value)));
}

void check_values(const RenderSettings& settings) {
    check_value("light samples", settings.light_samples);
    check_value("orientation of lines", settings.lines.orientation);
    check_value("offsets of lines", settings.lines.offsets);
    check_value("shading of lines", settings.lines.shading);
    check_value("choice for many occluders", settings.lines.many_occluders);
    check_value("technique", settings.technique);
    check_value("strategies", settings.strategies);
    check_value("emission sampling", settings.emission_sampling);
    check_value("heuristic of multiple importance sampling", settings.mis);
    check_value("pixel position", settings.pixel_position);
    check_value("sampler", settings.sample_order);
    check_value("BRDF", settings.brdf);
    for (const LayerKind layer : settings.layers) check_value("layer", layer);
}

void validate_lines(const RenderSettings& settings) {
    if (settings.technique == Technique::ltc_analytic)
        throw std::invalid_argument(
            "technique ltc_analytic has no shadows and does not support line samples");
    const int count = settings.lines.count;
    if (count < 1 || count > kMaxLines)
        throw std::invalid_argument("lines per shading point and light must lie between 1 and " +
                                    std::to_string(kMaxLines) + ", found " + std::to_string(count));
    const int camera_rays = camera_ray_count(settings);
    if (std::int64_t(count) * camera_rays > kMaxLinesPerPixel)
        throw std::invalid_argument("lines times camera rays must not exceed " +
                                    std::to_string(kMaxLinesPerPixel) + ", found " + std::to_string(count) +
                                    " times " + std::to_string(camera_rays));
}

} // namespace

void validate(const RenderSettings& settings) {
    check_values(settings);
    if (settings.samples < 1 || settings.samples > kMaxSamples)
        throw std::invalid_argument("samples per light and pixel must lie between 1 and " +
                                    std::to_string(kMaxSamples) + ", found " +
                                    std::to_string(settings.samples));
    if (!allows(settings.technique, settings.strategies))
        throw std::invalid_argument("strategies " + std::string(name_of(settings.strategies)) +
                                    " are not supported with technique " +
                                    std::string(name_of(settings.technique)));
    if (!allows(settings.strategies, settings.mis))
        throw std::invalid_argument("multiple importance sampling by " + std::string(name_of(settings.mis)) +
                                    " is not supported with strategies " +
                                    std::string(name_of(settings.strategies)));
    if (!(settings.visibility_estimate >= 0 && settings.visibility_estimate <= 1))
        throw std::invalid_argument("the visibility estimate must lie between 0 and 1, found " +
                                    std::to_string(settings.visibility_estimate));
    const int camera_rays = camera_ray_count(settings);
    if (camera_rays < 1 || settings.samples % camera_rays != 0)
        throw std::invalid_argument("camera rays per pixel must divide the " +
                                    std::to_string(settings.samples) + " samples per light, found " +
                                    std::to_string(camera_rays));
    if (settings.light_samples == LightSamples::lines) validate_lines(settings);
    const Part& part = settings.part;
    if (part.count < 1 || part.count > kMaxParts || part.number < 1 || part.number > part.count)
        throw std::invalid_argument("parts are numbered from 1 to their count, which is at most " +
                                    std::to_string(kMaxParts) + ", found " + std::to_string(part.number) +
                                    " of " + std::to_string(part.count));
}

} // namespace nusselt::render
