#include "render_cpu/integrator.h"

namespace nusselt::render_cpu {

// Each one is in the file of its name in kernel/integrators.
RenderTile direct_light(LaneCount<4>), direct_light(LaneCount<8>), direct_light(LaneCount<16>);

std::span<const Integrator> integrators() {
    static const Integrator kIntegrators[] = {
        {"direct_light",
         {direct_light(LaneCount<4>()), direct_light(LaneCount<8>()), direct_light(LaneCount<16>())}},
    };
    return kIntegrators;
}

} // namespace nusselt::render_cpu
