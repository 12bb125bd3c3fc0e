#include "render_cpu/kernel/tile.h"

namespace nusselt::render_cpu {

static_assert(nusselt::kernel::kLanes == 4, "compiled for another instruction set than the name says");

void render_tile_sse42(const RenderJob& job, const Tile& tile, const TileMemory& memory,
                       TileStatistics& statistics) {
    kernel::TileRenderer(job, tile, memory, statistics).render();
}

} // namespace nusselt::render_cpu
