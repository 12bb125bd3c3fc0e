#pragma once
/// The textures of polygonal lights, prepared for shaders/passes/lights/polygon_texture.glsl.

#include "interface/lights.h"
#include "scene/model/scene.h"

#include <nusselt/core/vec.h>

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace nusselt::render_vulkan {

/// Appends what lights show to the words of emission, once for all lights that show the same.
class PolygonTextures {
public:
    /// \param slots vertices that shaders have room for, 4 or 8
    /// \param words those of interface::kEmissionWordsBinding, which must outlive this object
    PolygonTextures(int slots, std::vector<std::uint32_t>& words) : slots_(slots), words_(words) {}

    /// Appends the texels of a light that has a texture, and what sampling needs to know about them.
    /// \throws std::runtime_error if 32 bits cannot number the words
    interface::PolygonTextureRecord add(const scene::Scene& scene, const scene::PolygonLight& light);

private:
    struct Texels {
        std::vector<Vec3<float>> radiance; ///< [W/(sr m^2)]
        std::uint32_t first_word = 0;
    };
    /// A texture and the radiance of a texel of 1.
    using TexelKey = std::tuple<const scene::EmissionTexture*, float, float, float>;
    /// Texels and the outline of a light in them.
    using CellKey = std::pair<const Texels*, std::vector<float>>;

    const Texels& find_texels(const scene::EmissionTexture& texture, const scene::Float3& scale);
    /// \returns the number of the first word
    std::uint32_t find_cells(const scene::EmissionTexture& texture, const Texels& texels,
                             const std::vector<Vec2<float>>& outline);

    int slots_;
    std::vector<std::uint32_t>& words_;
    std::map<TexelKey, Texels> texels_;
    std::map<CellKey, std::uint32_t> cells_;
};

} // namespace nusselt::render_vulkan
