#include "render_cpu/lights/light_kernel.h"
#include "render_cpu/lights/line_records.h"
#include "render_cpu/lights/polygon_records.h"

namespace nusselt::render_cpu {

std::span<const LightKernel> light_kernels() {
    static const LightKernel kKernels[] = {
        {make_polygon_records,
         {polygon_code(LaneCount<4>()), polygon_code(LaneCount<8>()), polygon_code(LaneCount<16>())},
         true},
        {make_line_records,
         {line_code(LaneCount<4>()), line_code(LaneCount<8>()), line_code(LaneCount<16>())},
         false},
    };
    return kKernels;
}

} // namespace nusselt::render_cpu
