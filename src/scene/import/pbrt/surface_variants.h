#pragma once
/// Differences between surfaces of one material.

#include "scene/import/pbrt/shape_directive.h"
#include "scene/import/pbrt/textures.h"

#include <compare>
#include <map>
#include <vector>

namespace nusselt::scene {

/// pbrt gives alpha to shapes, scene::Scene to materials; and what pbrt v3 measures heights of bump maps in depends on
/// the shape. Shapes that ask for it get a variant of their material, which all shapes share that ask for the same.
class SurfaceVariants {
public:
    /// Reads "alpha" and "shadowalpha". Throws SceneError on a missing texture.
    /// \param material  index into `materials`, of a surface
    /// \returns the index of the variant, `material` itself for most shapes
    int material(int material, ShapeDirective& shape, TextureTable& textures,
                 std::vector<Material>& materials, Warnings& warnings);

private:
    struct Key {
        int material;
        float alpha;
        int texture;
        BumpUnit bump_unit;
        auto operator<=>(const Key&) const = default;
    };
    std::map<Key, int> variants_;
};

} // namespace nusselt::scene
