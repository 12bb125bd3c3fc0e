#include "render_cpu/kernel/light_functions.h"

#include <nusselt/sampling/cylinder_area.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/cylinder_solid_angle.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

template <template <class, int> class Technique, int N>
void add_polygon(ReflectedLight& reflected, std::int32_t index) noexcept {
    const LocalPolygon<N> light = reflected.polygon<N>(index);
    if (any(light.lit)) add_samples(reflected, light, Technique<Real, N>(light.shape));
}

template <template <class> class Technique>
void add_line(ReflectedLight& reflected, std::int32_t index) noexcept {
    const LocalLine light = reflected.line(index);
    if (any(light.lit)) add_samples(reflected, light, Technique<Real>(light.shape));
}

template <template <class> class Technique>
void add_tube(ReflectedLight& reflected, std::int32_t index) noexcept {
    const LocalTube light = reflected.tube(index);
    if (any(light.lit)) add_samples(reflected, light, Technique<Real>(light.shape));
}

template <template <class, int> class Polygon, template <class> class Line, template <class> class Tube>
LightFunctions functions() noexcept {
    return {&add_polygon<Polygon, 4>, &add_polygon<Polygon, 8>, &add_line<Line>, &add_tube<Tube>};
}

template <class R, int N>
using PolygonPsa = PolygonProjectedSolidAngle<R, N>;
template <class R>
using LinePsa = LineProjectedSolidAngle<R>;

} // namespace

LightFunctions single_technique_functions(render::Technique technique) noexcept {
    switch (technique) {
    case render::Technique::area:
        return functions<PolygonArea, LineArea, CylinderArea>();
    case render::Technique::solid_angle:
        return functions<PolygonSolidAngle, LineSolidAngle, CylinderSolidAngle>();
    case render::Technique::clipped_solid_angle:
        return functions<PolygonClippedSolidAngle, LineClippedSolidAngle, CylinderSolidAngle>();
    case render::Technique::projected_solid_angle_biased:
        return functions<PolygonProjectedSolidAngleBiased, LinePsa, CylinderProjectedSolidAngle>();
    case render::Technique::projected_solid_angle:
    case render::Technique::ltc_analytic:
        break;
    }
    return functions<PolygonPsa, LinePsa, CylinderProjectedSolidAngle>();
}

} // namespace kernel
NUSSELT_NAMESPACE_END
