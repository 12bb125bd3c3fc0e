#include "render_cpu/lights/luminaire_tables.h"

#include <numbers>

namespace nusselt::render_cpu {

LuminaireTable LuminaireTables::add(const std::shared_ptr<const scene::Luminaire>& luminaire, double unit) {
    const auto [found, is_new] = tables_.try_emplace({luminaire, unit});
    Arrays& arrays = found->second;
    if (is_new) {
        const scene::IntensityTable& table = luminaire->profile.table();
        for (const double angle : table.vertical) arrays.vertical.push_back(static_cast<float>(angle));
        for (const double angle : table.horizontal) arrays.horizontal.push_back(static_cast<float>(angle));
        arrays.horizontal.push_back(static_cast<float>(table.horizontal.front() + 2 * std::numbers::pi));
        const double factor = unit > 0 ? 1 / unit : 0;
        for (const double candelas : table.candelas)
            arrays.intensity.push_back(static_cast<float>(factor * candelas));
        for (std::size_t i = 0; i < table.vertical.size(); ++i)
            arrays.intensity.push_back(arrays.intensity[i]);
    }
    return {arrays.vertical.data(), arrays.horizontal.data(), arrays.intensity.data(),
            static_cast<std::int32_t>(arrays.vertical.size()),
            static_cast<std::int32_t>(arrays.horizontal.size())};
}

} // namespace nusselt::render_cpu
