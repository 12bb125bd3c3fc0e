#include "render_vulkan/lights/luminaire_words.h"

#include "interface/profiles.h"
#include "render_vulkan/lights/emission_words.h"
#include "scene/model/profiles/intensity_arrays.h"

namespace nusselt::render_vulkan {

std::uint32_t LuminaireWords::add(const std::shared_ptr<const scene::Luminaire>& luminaire, double unit,
                                  std::vector<std::uint32_t>& words) {
    const auto [found, is_new] = first_words_.try_emplace({luminaire, unit});
    if (!is_new) return found->second;
    const scene::IntensityArrays arrays = scene::make_intensity_arrays(luminaire->profile, unit);
    found->second = grow_words(words, interface::kLuminaireAngles);
    words[found->second + interface::kLuminaireVerticals] =
        static_cast<std::uint32_t>(arrays.vertical.size());
    words[found->second + interface::kLuminaireHorizontals] =
        static_cast<std::uint32_t>(arrays.horizontal.size());
    for (const std::vector<float>* numbers : {&arrays.vertical, &arrays.horizontal, &arrays.intensity})
        add_floats(*numbers, words);
    return found->second;
}

} // namespace nusselt::render_vulkan
