#include "render_cpu/kernel/lights/portal_light.h"
#include "render_cpu/kernel/point_samples.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

template <>
render_cpu::AddLight portal_points<4>(const render_cpu::RenderJob& job) noexcept {
    return point_samples<PortalLight<4>>(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
