#pragma once
/// The bounding volume hierarchy that lines of lights are traced with; see line_traversal.h.

#include "scene/scene.h"
#include "visibility/line_bvh_view.h"

#include <cstddef>
#include <memory>

namespace nusselt::visibility {

/// The surfaces of a scene that rays can hit. Instances share the hierarchies of their objects. Immutable, usable from
/// several threads at once.
class LineBvh {
public:
    /// Builds the hierarchy with the threads of the caller's oneTBB arena. Triangles with coordinates that are not finite
    /// are left out.
    /// \param scene not needed afterwards
    /// \throws std::runtime_error for a lack of memory
    explicit LineBvh(const scene::Scene& scene);
    ~LineBvh();
    LineBvh(LineBvh&&) noexcept;
    LineBvh& operator=(LineBvh&&) noexcept;

    /// Valid as long as this object lives.
    LineBvhView view() const;

    /// Bytes of all arrays.
    std::size_t bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace nusselt::visibility
