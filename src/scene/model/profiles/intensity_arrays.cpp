#include "scene/model/profiles/intensity_arrays.h"

#include <numbers>

namespace nusselt::scene {

IntensityArrays make_intensity_arrays(const IntensityProfile& profile, double unit) {
    const IntensityTable& table = profile.table();
    IntensityArrays arrays;
    for (const double angle : table.vertical) arrays.vertical.push_back(static_cast<float>(angle));
    for (const double angle : table.horizontal) arrays.horizontal.push_back(static_cast<float>(angle));
    arrays.horizontal.push_back(static_cast<float>(table.horizontal.front() + 2 * std::numbers::pi));
    const double factor = unit > 0 ? 1 / unit : 0;
    for (const double candelas : table.candelas)
        arrays.intensity.push_back(static_cast<float>(factor * candelas));
    for (std::size_t i = 0; i < table.vertical.size(); ++i) arrays.intensity.push_back(arrays.intensity[i]);
    return arrays;
}

} // namespace nusselt::scene
