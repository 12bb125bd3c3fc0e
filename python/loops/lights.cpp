#include "python/loops/lights.h"

#include <algorithm>
#include <vector>

namespace nusselt::python {

namespace {

/// So many lights have a pack each, so that many samples of each fill the lanes. More lights fill them anyway.
constexpr std::size_t kMostAlone = 64;

/// Prepares packs of lights. \param light_of the light of a lane, counted over all packs
template <class Scalar, class LightOf>
void prepare(const TechniqueRow<Scalar>& row, const Scalar* numbers, int columns, std::size_t packs,
             const LightOf& light_of, char* memory) {
    const auto lanes = static_cast<std::size_t>(row.lanes);
    const auto width = static_cast<std::size_t>(columns);
    std::vector<Scalar> pack(width * lanes);
    for (std::size_t i = 0; i < packs; ++i) {
        for (std::size_t lane = 0; lane < lanes; ++lane)
            for (std::size_t k = 0; k < width; ++k)
                pack[k * lanes + lane] = numbers[light_of(i * lanes + lane) * width + k];
        Block<Scalar> block;
        block.packs = 1;
        block.columns = columns;
        block.inputs[0] = {pack.data(), lanes};
        row.prepare(block, memory + i * row.bytes);
    }
}

std::size_t group_count(std::size_t lights, int lanes) {
    return lights < 2 ? 0 : (lights - 1) / static_cast<std::size_t>(lanes) + 1;
}

} // namespace

template <class Scalar>
Lights<Scalar>::Lights(const TechniqueRow<Scalar>& row, const Scalar* numbers, int columns, std::size_t count)
    : row_(row),
      count_(count),
      alone_(count <= kMostAlone ? count * row.bytes : 0),
      groups_(group_count(count, row.lanes) * row.bytes) {
    const auto lanes = static_cast<std::size_t>(row.lanes);
    if (alone_.get() != nullptr)
        prepare(
            row, numbers, columns, count, [&](std::size_t lane) { return lane / lanes; }, alone_.get());
    // Lanes behind the last light have that light.
    if (groups_.get() != nullptr)
        prepare(
            row, numbers, columns, group_count(count, row.lanes),
            [&](std::size_t lane) { return std::min(lane, count - 1); }, groups_.get());
}

template class Lights<float>;
template class Lights<double>;

} // namespace nusselt::python
