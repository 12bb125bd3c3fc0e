#pragma once
/// Mouse and keys over the picture.

#include "picking.h"
#include "viewer.h"
#include "window.h"

namespace nusselt::viewer {

/// Lights follow the mouse at once if that takes no longer [s], else when the button is released.
inline constexpr double kQuickBuild = 0.1;

class Controls {
public:
    /// Flies the camera, selects and drags lights, moves the wipe. To be called between frames of Dear ImGui.
    void apply(const Window& window, const PicturePlace& place, Viewer& viewer);

    bool shows_panels() const { return shows_panels_; }

private:
    void fly(const Window& window, Viewer& viewer);
    void drag(const PicturePlace& place, Viewer& viewer);
    void move_light(FilmPosition to, bool is_final, Viewer& viewer);

    enum class Drag { none, wipe, pressed_light, light };

    Drag drag_ = Drag::none;
    FilmPosition drag_begin_; ///< where the light was last
    double speed_ = 1;        ///< of the camera, factor
    bool shows_panels_ = true;
    bool is_panel_key_down_ = false;
};

} // namespace nusselt::viewer
