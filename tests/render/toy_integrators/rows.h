#pragma once
/// The rows of integrators that only tests have.

#include "render_cpu/integrator.h"

namespace nusselt::render_cpu {

RenderTile toy_normals(LaneCount<4>), toy_normals(LaneCount<8>), toy_normals(LaneCount<16>);
RenderTile toy_last_light(LaneCount<4>), toy_last_light(LaneCount<8>), toy_last_light(LaneCount<16>);

inline const Integrator kToyIntegrators[] = {
    {"normals", {toy_normals(LaneCount<4>()), toy_normals(LaneCount<8>()), toy_normals(LaneCount<16>())}},
    {"last_light",
     {toy_last_light(LaneCount<4>()), toy_last_light(LaneCount<8>()), toy_last_light(LaneCount<16>())}},
};

} // namespace nusselt::render_cpu
