#pragma once
/// The luminaires of lights, for shaders/passes/lights/luminaire.glsl.

#include "scene/model/profiles/luminaire.h"

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace nusselt::render_vulkan {

class LuminaireWords {
public:
    /// Appends the table of a luminaire, whose intensities are divided by a number. Equal ones are appended once.
    /// \param unit [cd], positive; 0 gives a dark table
    /// \param words those of interface::kEmissionWordsBinding, the same ones for all calls
    /// \returns the number of the first word, see interface/profiles.h
    /// \throws std::runtime_error if 32 bits cannot number the words
    std::uint32_t add(const std::shared_ptr<const scene::Luminaire>& luminaire, double unit,
                      std::vector<std::uint32_t>& words);

private:
    std::map<std::pair<std::shared_ptr<const scene::Luminaire>, double>, std::uint32_t> first_words_;
};

} // namespace nusselt::render_vulkan
