#pragma once
/// The graphics state of a scene file and its stack.

#include "scene/materials.h"
#include "scene/shapes.h"
#include "scene/transform.h"

#include <optional>
#include <vector>

namespace nusselt::scene {

/// Index of materials whose surfaces are left out.
constexpr int kInvisible = -1;

/// A material directive and, once a shape uses it, its index in the scene (or kInvisible).
struct MaterialEntry {
    MaterialDirective directive;
    std::optional<int> index;
};

struct GraphicsState {
    Transform ctm; ///< current transform
    bool reverse_orientation = false;
    Emission emission;
    MaterialEntry* material = nullptr;
};

/// What opened a block. A block of transforms restores only the transform at its end.
enum class StateBlock { attribute, transform, object, import };

class StateStack {
public:
    GraphicsState& current() { return current_; }
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
