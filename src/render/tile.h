#pragma once
/// Tiles, the pieces in which images are rendered. They are plain data because kernels for all instruction sets read
/// them.

#include <cstdint>

namespace nusselt::render {

/// Pixels x_begin <= x < x_end, y_begin <= y < y_end of the film.
struct Tile {
    std::int32_t x_begin, y_begin, x_end, y_end;
};

} // namespace nusselt::render
