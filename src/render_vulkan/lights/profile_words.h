#pragma once
/// The profiles of lights with an extent, prepared for shaders/passes/lights/profile.glsl.

#include "render_vulkan/lights/luminaire_words.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_vulkan {

class ProfileWords {
public:
    /// \param words those of interface::kEmissionWordsBinding, which must outlive this object
    explicit ProfileWords(std::vector<std::uint32_t>& words) : words_(words) {}

    /// Appends the profile of a light that has one. \returns the number of the first word, see interface/profiles.h
    /// \throws std::runtime_error if 32 bits cannot number the words
    std::uint32_t add(const scene::Scene& scene, const scene::PolygonLight& light);
    std::uint32_t add(const scene::Scene& scene, const scene::LineLight& light);

private:
    std::uint32_t add(const scene::EmissionProfile& profile, float mean,
                      const scene::ProfilePlacement& placement, std::uint32_t tube_spread);

    std::vector<std::uint32_t>& words_;
    LuminaireWords luminaires_;
};

} // namespace nusselt::render_vulkan
