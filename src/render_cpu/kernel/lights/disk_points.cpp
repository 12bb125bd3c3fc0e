#include "render_cpu/kernel/lights/round_light.h"
#include "render_cpu/kernel/point_samples.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

render_cpu::AddLight disk_points(const render_cpu::RenderJob& job) noexcept {
    return point_samples<RoundLight<Disk>>(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
