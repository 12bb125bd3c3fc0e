#pragma once
/// The bounding volume hierarchy that lines of lights are traced with; see line_traversal.h.

#include "scene/model/scene.h"
#include "visibility/line_bvh_view.h"

#include <memory>

namespace nusselt::visibility {

/// The surfaces of a scene that rays can hit. Instances share the hierarchies of their objects. Immutable, usable from
/// several threads at once.
class LineBvh {
public:
    /// Builds the hierarchy with the threads of the caller's oneTBB arena. Triangles and instances with coordinates that
    /// are not finite, or beyond 1.8e18, are left out, as in Embree's scenes.
    /// \param scene not needed afterwards
    /// \throws std::runtime_error for a lack of memory, a hierarchy deeper than kLargestBvhDepth and what else Embree's
    ///         builder reports
    explicit LineBvh(const scene::Scene& scene);
    ~LineBvh();
    LineBvh(LineBvh&&) noexcept;
    LineBvh& operator=(LineBvh&&) noexcept;

    /// Valid as long as this object lives.
    LineBvhView view() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace nusselt::visibility
