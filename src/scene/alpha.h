#pragma once
/// The alpha of shapes.

#include "scene/parameters.h"
#include "scene/textures.h"

#include <compare>
#include <map>
#include <vector>

namespace nusselt::scene {

/// pbrt gives alpha to shapes, scene::Scene to materials: shapes with an alpha get a variant of their material, which
/// shapes of equal alpha share.
class AlphaVariants {
public:
    /// Reads "alpha" and "shadowalpha". Throws SceneError on a missing texture.
    /// \param material  index into `materials`, of a surface
    /// \returns the index of the variant, `material` itself for opaque shapes
    int material(int material, ParameterList& shape, TextureTable& textures, std::vector<Material>& materials,
                 Warnings& warnings);

private:
    struct Key {
        int material;
        float alpha;
        int texture;
        auto operator<=>(const Key&) const = default;
    };
    std::map<Key, int> variants_;
};

} // namespace nusselt::scene
