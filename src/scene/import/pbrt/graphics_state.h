#pragma once
/// The graphics state of a scene file and its stack.

#include "scene/build/lights/emission.h"
#include "scene/import/pbrt/materials.h"
#include "scene/import/pbrt/shape_directive.h"
#include "scene/model/transform.h"

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// Index of materials whose surfaces are left out.
constexpr int kInvisible = kNoMaterial;

/// A material directive and, once a shape uses it, its index in the scene (or kInvisible).
struct MaterialEntry {
    MaterialDirective directive;
    std::optional<int> index;
};

/// The kind of directives for whose parameters an Attribute directive sets defaults.
enum class AttributeTarget : std::size_t { shape, light, material, texture, medium };
constexpr std::array<std::string_view, 5> kAttributeTargets = {"shape", "light", "material", "texture",
                                                               "medium"};

struct GraphicsState {
    Transform ctm;           ///< current transform, at the begin of the shutter's time
    bool moves_begin = true; ///< whether transforms apply to the begin of the shutter's time
    bool reverse_orientation = false;
    const ColourSpace* colour_space = &kSrgb;
    Emission emission;
    MaterialEntry* material = nullptr;
    /// The defaults of each target; null if it has none.
    std::array<std::shared_ptr<const std::vector<Parameter>>, kAttributeTargets.size()> defaults;
};

/// The directive that opened a block. A block of transforms restores only transforms at its end.
enum class StateBlock { attribute, transform, object, import };

class StateStack {
public:
    GraphicsState& current() { return current_; }
    const GraphicsState& current() const { return current_; }
    /// Throws SceneError if there are too many blocks in each other.
    void push(StateBlock block, const Location& location);
    /// Throws SceneError unless the innermost block is of this kind.
    void pop(StateBlock block, const Location& location);
    void warn_if_open(Warnings& warnings) const;

private:
    struct Saved {
        StateBlock block;
        Location location;
        GraphicsState state;
    };
    GraphicsState current_;
    std::vector<Saved> saved_;
};

} // namespace nusselt::scene
