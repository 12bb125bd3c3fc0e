#include "controls.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nusselt::viewer {

namespace {

constexpr double kTurnPerPixel = 0.004;   ///< [rad]
constexpr double kSpeed = 0.25;           ///< scene radii per second
constexpr double kSpeedOfWheel = 1.2;     ///< factor per notch
constexpr float kWipeTolerance = 6;       ///< [pixels of the window]
constexpr float kDragTolerance = 4;       ///< clicks move by less [pixels of the window]
constexpr double kLongestTimeStep = 0.25; ///< [s], where frames take longer

FilmPosition film_position(const PicturePlace& place, const ImVec2& mouse, const scene::Film& film) {
    return {static_cast<double>((mouse.x - place.x) / place.width) * film.width,
            static_cast<double>((mouse.y - place.y) / place.height) * film.height};
}

double axis(const Window& window, int positive, int negative) {
    return (window.is_key_down(positive) ? 1 : 0) - (window.is_key_down(negative) ? 1 : 0);
}

} // namespace

void Controls::fly(const Window& window, Viewer& viewer) {
    const ImGuiIO& io = ImGui::GetIO();
    FlyCamera& camera = viewer.state.camera;
    if (!io.WantCaptureKeyboard) {
        const double step = std::min(static_cast<double>(io.DeltaTime), kLongestTimeStep) * speed_ * kSpeed *
                            viewer.session.loaded().radius * (io.KeyShift ? 4 : 1);
        const scene::Double3 way = {axis(window, GLFW_KEY_D, GLFW_KEY_A),
                                    axis(window, GLFW_KEY_Q, GLFW_KEY_E),
                                    axis(window, GLFW_KEY_W, GLFW_KEY_S)};
        if (length(way) > 0) camera.move(step * way);
    }
    if (io.WantCaptureMouse) return;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0))
        camera.turn(kTurnPerPixel * static_cast<double>(io.MouseDelta.x),
                    -kTurnPerPixel * static_cast<double>(io.MouseDelta.y));
    if (io.MouseWheel != 0) speed_ *= std::pow(kSpeedOfWheel, static_cast<double>(io.MouseWheel));
    speed_ = std::clamp(speed_, 1e-3, 1e3);
}

void Controls::move_light(FilmPosition to, bool is_final, Viewer& viewer) {
    ViewState& state = viewer.state;
    if (!state.selected_light || (!is_final && viewer.session.times().build > kQuickBuild)) return;
    const scene::Double3 way = drag_of(viewer.session.loaded(), state.edits, *state.selected_light,
                                       state.camera.camera(), drag_begin_, to);
    drag_begin_ = to;
    if (way == scene::Double3{}) return;
    LightEdit edit = state.edits.get(*state.selected_light);
    edit.move = edit.move + way;
    state.edits.set(*state.selected_light, edit);
}

void Controls::drag(const PicturePlace& place, Viewer& viewer) {
    const ImGuiIO& io = ImGui::GetIO();
    ViewState& state = viewer.state;
    const FilmPosition at = film_position(place, io.MousePos, viewer.session.loaded().film);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.WantCaptureMouse) {
        const float wipe = place.x + static_cast<float>(state.wipe) * place.width;
        if (state.is_split && std::abs(io.MousePos.x - wipe) <= kWipeTolerance) {
            drag_ = Drag::wipe;
        } else {
            state.selected_light = light_at(viewer.session.loaded(), state.edits, state.camera.camera(), at);
            if (state.selected_light) drag_ = Drag::pressed_light;
            drag_begin_ = at;
        }
    }
    if (drag_ == Drag::wipe)
        state.wipe = std::clamp(static_cast<double>((io.MousePos.x - place.x) / place.width), 0.0, 1.0);
    if (drag_ == Drag::pressed_light && ImGui::IsMouseDragging(ImGuiMouseButton_Left, kDragTolerance))
        drag_ = Drag::light;
    const bool is_released = ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    if (drag_ == Drag::light && (at.x != drag_begin_.x || at.y != drag_begin_.y))
        move_light(at, is_released, viewer);
    if (is_released) drag_ = Drag::none;
}

void Controls::apply(const Window& window, const PicturePlace& place, Viewer& viewer) {
    const bool was_down = std::exchange(is_panel_key_down_, window.is_key_down(GLFW_KEY_F1));
    if (is_panel_key_down_ && !was_down) shows_panels_ = !shows_panels_;
    fly(window, viewer);
    drag(place, viewer);
    if (viewer.state.is_split) {
        const float x = place.x + static_cast<float>(viewer.state.wipe) * place.width;
        ImGui::GetBackgroundDrawList()->AddLine({x, place.y}, {x, place.y + place.height},
                                                IM_COL32(255, 255, 255, 160), 1);
    }
}

} // namespace nusselt::viewer
