#pragma once
/// Mouse and keys over the picture.

#include "window.h"

#include "viewer/viewer.h"

#include <set>

namespace nusselt::viewer {

class Controls {
public:
    /// Flies the camera, selects and drags lights, moves the wipe, and draws their handles. To be called between frames of
    /// Dear ImGui.
    void apply(const Window& window, const PicturePlace& place, Viewer& viewer);

private:
    void fly(const Window& window, Viewer& viewer);
    void look(Viewer& viewer);
    void point(const PicturePlace& place, Viewer& viewer);

    void use_shortcuts(const Window& window, Viewer& viewer);
    /// Whether a key went down since the last call.
    bool goes_down(const Window& window, int key);

    std::set<int> keys_down_;
    bool is_orbiting_ = false;
    double speed_ = 1; ///< of the camera, factor
};

} // namespace nusselt::viewer
