#include "render_cpu/lights/distant_records.h"
#include "render_cpu/lights/environment_records.h"
#include "render_cpu/lights/light_kernel.h"
#include "render_cpu/lights/line_records.h"
#include "render_cpu/lights/point_records.h"
#include "render_cpu/lights/polygon_records.h"
#include "render_cpu/lights/round_records.h"

namespace nusselt::render_cpu {

std::span<const LightKernel> light_kernels() {
    static const LightKernel kKernels[] = {
        {make_polygon_records,
         {polygon_code(LaneCount<4>()), polygon_code(LaneCount<8>()), polygon_code(LaneCount<16>())},
         true},
        {make_round_records,
         {round_code(LaneCount<4>()), round_code(LaneCount<8>()), round_code(LaneCount<16>())},
         false},
        {make_line_records,
         {line_code(LaneCount<4>()), line_code(LaneCount<8>()), line_code(LaneCount<16>())},
         false},
        {make_point_records,
         {point_code(LaneCount<4>()), point_code(LaneCount<8>()), point_code(LaneCount<16>())},
         false},
        {make_environment_records,
         {environment_code(LaneCount<4>()), environment_code(LaneCount<8>()),
          environment_code(LaneCount<16>())},
         false},
        {make_distant_records,
         {distant_code(LaneCount<4>()), distant_code(LaneCount<8>()), distant_code(LaneCount<16>())},
         false},
    };
    return kKernels;
}

} // namespace nusselt::render_cpu
