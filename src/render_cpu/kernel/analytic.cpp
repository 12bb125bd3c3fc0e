#include "render_cpu/kernel/light_functions.h"

#include <nusselt/ltc/line_shading.h>
#include <nusselt/ltc/polygon_shading.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

template <class Shape>
void add_light(ReflectedLight& reflected, const LocalLight<Shape>& light) noexcept {
    if (!any(light.lit)) return;
    const auto& surface = reflected.surface().glossy;
    const Vector diffuse = diffuse_integral(light.shape) * surface.diffuse_albedo;
    const Vector specular = lobe_integral<BothHorizons>(light.shape, surface.lobe) * surface.specular_albedo;
    reflected.add_known(light, {diffuse + specular, diffuse});
}

template <int N>
void add_polygon(ReflectedLight& reflected, std::int32_t index) noexcept {
    add_light(reflected, reflected.polygon<N>(index));
}

void add_line(ReflectedLight& reflected, std::int32_t index) noexcept {
    add_light(reflected, reflected.line(index));
}

void add_tube(ReflectedLight& reflected, std::int32_t index) noexcept {
    const LocalTube light = reflected.tube(index);
    if (!any(light.lit)) return;
    const auto& surface = reflected.surface().glossy;
    const LineSegment<Real>& axis = light.shape.axis;
    const Real& radius = light.shape.radius;
    const Vector diffuse = tube_integral(diffuse_integral(axis), radius) * surface.diffuse_albedo;
    const Vector specular =
        tube_integral(lobe_integral<BothHorizons>(axis, surface.lobe), radius) * surface.specular_albedo;
    reflected.add_known(light, {diffuse + specular, diffuse});
}

} // namespace

LightFunctions analytic_functions() noexcept {
    return {&add_polygon<4>, &add_polygon<8>, &add_line, &add_tube};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
