#include "render_cpu/begun_tile.h"

#include <cstring>
#include <stdexcept>

namespace nusselt::render_cpu {

namespace {

// A state consists of the progress, the sums, and all rows of the tile: image, layers, numbers of camera rays.

template <class AnyFrame, class Function>
void for_each_stored_row(AnyFrame& frame, std::size_t tile, const Function& function) {
    for_each_row(frame, frame.tiles[tile], function);
    for_each_row(frame, frame.tiles[tile], frame.rays, 1, function);
}

std::size_t state_size(const Frame& frame, std::size_t tile, std::size_t sum_bytes) {
    std::size_t size = sizeof(TileProgress) + sum_bytes;
    for_each_stored_row(frame, tile, [&](const float*, std::size_t count) { size += count * sizeof(float); });
    return size;
}

} // namespace

std::vector<std::byte> store_begun_tile(const Frame& frame, std::size_t tile, const TileProgress& progress,
                                        std::span<const std::byte> sums) {
    std::vector<std::byte> state(state_size(frame, tile, sums.size()));
    std::byte* end = state.data();
    const auto append = [&](const void* data, std::size_t size) {
        std::memcpy(end, data, size);
        end += size;
    };
    append(&progress, sizeof progress);
    append(sums.data(), sums.size());
    for_each_stored_row(frame, tile,
                        [&](const float* row, std::size_t count) { append(row, count * sizeof(float)); });
    return state;
}

void restore_pixels(Frame& frame, std::size_t tile, std::span<const std::byte> state, std::size_t sum_bytes) {
    if (state.size() != state_size(frame, tile, sum_bytes))
        throw std::runtime_error("the checkpoint is damaged: a tile that it began has the wrong size");
    const std::byte* begin = state.data() + sizeof(TileProgress) + sum_bytes;
    for_each_stored_row(frame, tile, [&](float* row, std::size_t count) {
        std::memcpy(row, begin, count * sizeof(float));
        begin += count * sizeof(float);
    });
}

TileProgress restore_sums(std::span<const std::byte> state, std::span<std::byte> sums) {
    TileProgress progress{};
    std::memcpy(&progress, state.data(), sizeof progress);
    std::memcpy(sums.data(), state.data() + sizeof progress, sums.size());
    return progress;
}

} // namespace nusselt::render_cpu
