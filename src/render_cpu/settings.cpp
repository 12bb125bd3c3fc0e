#include "render_cpu/settings.h"

#include <stdexcept>
#include <string>

namespace nusselt::render_cpu {

int camera_ray_count(const RenderSettings& settings) {
    if (settings.camera_rays) return *settings.camera_rays;
    return settings.pixel_position == PixelPosition::center ? 1 : settings.samples;
}

void validate(const RenderSettings& settings) {
    if (settings.samples < 1 || settings.samples > kMaxSamples)
        throw std::invalid_argument("samples per light and pixel must lie between 1 and " +
                                    std::to_string(kMaxSamples) + ", found " +
                                    std::to_string(settings.samples));
    const int camera_rays = camera_ray_count(settings);
    if (camera_rays < 1 || settings.samples % camera_rays != 0)
        throw std::invalid_argument("camera rays per pixel must divide the " +
                                    std::to_string(settings.samples) + " samples per light, found " +
                                    std::to_string(camera_rays));
}

std::string_view name_of(Technique technique) {
    switch (technique) {
    case Technique::area:
        return "area";
    case Technique::solid_angle:
        return "solid_angle";
    case Technique::clipped_solid_angle:
        return "clipped_solid_angle";
    case Technique::projected_solid_angle:
        return "projected_solid_angle";
    case Technique::projected_solid_angle_biased:
        return "projected_solid_angle_biased";
    }
    return {};
}

std::string_view name_of(SampleOrder order) {
    switch (order) {
    case SampleOrder::independent:
        return "independent";
    case SampleOrder::sobol:
        return "sobol";
    case SampleOrder::jittered:
        return "jittered";
    }
    return {};
}

std::string_view name_of(PixelPosition position) {
    switch (position) {
    case PixelPosition::jittered:
        return "jittered";
    case PixelPosition::center:
        return "center";
    }
    return {};
}

std::string_view name_of(BrdfChoice brdf) {
    switch (brdf) {
    case BrdfChoice::material:
        return "material";
    case BrdfChoice::lambert:
        return "lambert";
    }
    return {};
}

} // namespace nusselt::render_cpu
