#include "render_cpu/lights/luminaire_tables.h"

namespace nusselt::render_cpu {

LuminaireTable LuminaireTables::add(const std::shared_ptr<const scene::Luminaire>& luminaire, double unit) {
    const auto [found, is_new] = tables_.try_emplace({luminaire, unit});
    scene::IntensityArrays& arrays = found->second;
    if (is_new) arrays = scene::make_intensity_arrays(luminaire->profile, unit);
    return {arrays.vertical.data(), arrays.horizontal.data(), arrays.intensity.data(),
            static_cast<std::int32_t>(arrays.vertical.size()),
            static_cast<std::int32_t>(arrays.horizontal.size())};
}

} // namespace nusselt::render_cpu
