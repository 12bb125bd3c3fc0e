#pragma once
/// What images are rendered in, piece by piece. Plain data: kernels for all instruction sets read this.

#include <cstdint>

namespace nusselt::render {

/// Pixels x_begin <= x < x_end, y_begin <= y < y_end of the film.
struct Tile {
    std::int32_t x_begin, y_begin, x_end, y_end;
};

} // namespace nusselt::render
