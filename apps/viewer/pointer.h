#pragma once
/// The left mouse button over the picture: selects and drags lights, their handles and the wipe.

#include "viewer/lights/light_handles.h"
#include "viewer/lights/picking.h"

#include <optional>

namespace nusselt::viewer {

struct Viewer;
struct ViewState;

/// Lights follow the mouse at once if that takes no longer [s], else when the button is released.
inline constexpr double kQuickBuild = 0.1;

class Pointer {
public:
    /// \param pixel the width of a pixel of the window [pixels of the film]
    void press(FilmPosition at, double pixel, Viewer& viewer);
    void move_to(FilmPosition at, Viewer& viewer);
    void release(Viewer& viewer);

    /// The handle that is dragged.
    const std::optional<Handle>& handle() const { return handle_; }

private:
    /// Moves or turns the selected light as far as the mouse moved. \returns whether that changes it
    bool change_light(ViewState& state, const scene::Scene& scene);

    enum class Drag { none, wipe, pressed_light, light };

    Drag drag_ = Drag::none;
    std::optional<Handle> handle_; ///< else the light itself
    FilmPosition begin_;           ///< where the light was last
    FilmPosition now_;
    double tolerance_ = 0; ///< clicks move by less [pixels of the film]
};

/// The handles of the selected light, if there is one.
std::optional<LightHandles> selected_handles(const Viewer& viewer);

} // namespace nusselt::viewer
