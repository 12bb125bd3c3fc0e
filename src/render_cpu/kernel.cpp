/// Compiled once per instruction set; see renderer.cpp.

#include "render_cpu/kernel/tile.h"

namespace nusselt::render_cpu {

template <>
void render_tile<base::Isa::NUSSELT_UNIT_ISA>(const RenderJob& job, const Tile& tile,
                                              const TileMemory& memory, TileStatistics& statistics) {
    static_assert(base::Isa::NUSSELT_UNIT_ISA != base::Isa::sse42 || kernel::kLanes == 4);
    static_assert(base::Isa::NUSSELT_UNIT_ISA != base::Isa::avx2 || kernel::kLanes == 8);
    static_assert(base::Isa::NUSSELT_UNIT_ISA != base::Isa::avx512 || kernel::kLanes == 16);
    kernel::TileRenderer(job, tile, memory, statistics).render();
}

} // namespace nusselt::render_cpu
