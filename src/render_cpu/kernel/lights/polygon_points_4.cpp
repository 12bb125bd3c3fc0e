#include "render_cpu/kernel/lights/polygon_light.h"
#include "render_cpu/kernel/point_samples.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

template <>
render_cpu::AddLight polygon_points<4>(const render_cpu::RenderJob& job) noexcept {
    return point_samples<PolygonLight<4>>(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
