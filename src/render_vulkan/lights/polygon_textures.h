#pragma once
/// The textures of polygonal lights, prepared for shaders/passes/lights/polygon_texture.glsl.

#include "interface/lights.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_vulkan {

/// Appends the texels of a light that has a texture, and what sampling needs to know about them.
/// \param slots vertices that shaders have room for, 4 or 8
/// \param words those of interface::kEmissionWordsBinding
/// \throws std::runtime_error if 32 bits cannot number the words
interface::PolygonTextureRecord add_texture(const scene::Scene& scene, const scene::PolygonLight& light,
                                            int slots, std::vector<std::uint32_t>& words);

} // namespace nusselt::render_vulkan
