#include "pointer.h"

#include "viewer.h"

#include <algorithm>
#include <cmath>

namespace nusselt::viewer {

namespace {

// [pixels of the window]
constexpr double kWipeTolerance = 6;
constexpr double kHandleTolerance = 6;
constexpr double kDragTolerance = 4;

} // namespace

std::optional<LightHandles> selected_handles(const Viewer& viewer) {
    const ViewState& state = viewer.state;
    const scene::Scene& scene = viewer.session.loaded();
    if (!state.selected_light || !state.edits.has(scene, *state.selected_light)) return std::nullopt;
    return LightHandles(state.edits.center(scene, *state.selected_light), state.camera.camera(),
                        scene.film.width);
}

void Pointer::press(FilmPosition at, double pixel, Viewer& viewer) {
    ViewState& state = viewer.state;
    const scene::Scene& scene = viewer.session.loaded();
    tolerance_ = kDragTolerance * pixel;
    begin_ = now_ = at;
    handle_.reset();
    if (state.is_split && std::abs(at.x - state.wipe * scene.film.width) <= kWipeTolerance * pixel) {
        drag_ = Drag::wipe;
        return;
    }
    const scene::Camera camera = state.camera.camera();
    if (const auto handles = selected_handles(viewer))
        handle_ = handles->at(at, camera, kHandleTolerance * pixel);
    if (!handle_) state.selected_light = light_at(scene, state.edits, camera, at);
    drag_ = state.selected_light ? Drag::pressed_light : Drag::none;
}

void Pointer::move_to(FilmPosition at, Viewer& viewer) {
    const bool has_moved = at.x != now_.x || at.y != now_.y;
    now_ = at;
    if (drag_ == Drag::wipe)
        viewer.state.wipe = std::clamp(at.x / viewer.session.loaded().film.width, 0.0, 1.0);
    if (drag_ == Drag::pressed_light && std::hypot(at.x - begin_.x, at.y - begin_.y) >= tolerance_)
        drag_ = Drag::light;
    if (drag_ == Drag::light && has_moved && viewer.session.times().build <= kQuickBuild)
        viewer.is_moving |= change_light(viewer.state, viewer.session.loaded());
}

void Pointer::release(Viewer& viewer) {
    if (drag_ == Drag::light) change_light(viewer.state, viewer.session.loaded());
    drag_ = Drag::none;
    handle_.reset();
    viewer.finish_edit();
}

bool Pointer::change_light(ViewState& state, const scene::Scene& scene) {
    if (!state.selected_light) return false;
    const std::size_t light = *state.selected_light;
    const scene::Double3 center = state.edits.center(scene, light);
    const scene::Camera camera = state.camera.camera();
    LightEdit edit = state.edits.get(light);
    if (!handle_)
        edit.move = edit.move + drag_of(center, camera, begin_, now_);
    else if (handle_->action == HandleAction::move)
        edit.move = edit.move + drag_along(handle_->axis, center, camera, begin_, now_);
    else
        edit.turn = combined_turn(edit.turn, turn_about(handle_->axis, center, camera, begin_, now_));
    begin_ = now_;
    if (edit == state.edits.get(light)) return false;
    state.edits.set(light, edit);
    return true;
}

} // namespace nusselt::viewer
