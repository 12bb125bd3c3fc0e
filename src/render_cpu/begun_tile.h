#pragma once
/// Tiles that go on where a rendering was stopped.

#include "render/frame.h"
#include "render_cpu/kernel.h"

#include <cstddef>
#include <span>
#include <vector>

namespace nusselt::render_cpu {

/// All that a kernel needs to go on with a tile, see BegunTiles.
/// \param sums the sums of the packet of pixels that is not finished
std::vector<std::byte> store_begun_tile(const Frame& frame, std::size_t tile, const TileProgress& progress,
                                        std::span<const std::byte> sums);

/// Restores the pixels that the tile has so far.
/// \param state from store_begun_tile()
/// \param sum_bytes the size of the sums
/// \throws std::runtime_error if the state has another size
void restore_pixels(Frame& frame, std::size_t tile, std::span<const std::byte> state, std::size_t sum_bytes);

/// Restores the sums.
/// \param state one that restore_pixels() accepted, with sums of this size
TileProgress restore_sums(std::span<const std::byte> state, std::span<std::byte> sums);

} // namespace nusselt::render_cpu
