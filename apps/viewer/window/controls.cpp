#include "controls.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace nusselt::viewer {

namespace {

constexpr double kTurnPerPixel = 0.004;   ///< [rad]
constexpr double kSpeed = 0.25;           ///< scene radii per second
constexpr double kSpeedOfWheel = 1.2;     ///< factor per notch
constexpr double kLongestTimeStep = 0.25; ///< [s], where frames take longer

constexpr ImU32 kOutlineColour = IM_COL32(255, 200, 60, 255);
constexpr ImU32 kActiveColour = IM_COL32(255, 255, 120, 255);
constexpr ImU32 kAxisColours[] = {IM_COL32(235, 70, 70, 255), IM_COL32(90, 210, 90, 255),
                                  IM_COL32(90, 140, 255, 255)};

FilmPosition film_position(const PicturePlace& place, const ImVec2& mouse, const scene::Film& film) {
    return {static_cast<double>((mouse.x - place.x) / place.width) * film.width,
            static_cast<double>((mouse.y - place.y) / place.height) * film.height};
}

double axis(const Window& window, int positive, int negative) {
    return (window.is_key_down(positive) ? 1 : 0) - (window.is_key_down(negative) ? 1 : 0);
}

/// Draws over the picture.
class Overlay {
public:
    Overlay(const PicturePlace& place, const scene::Film& film)
        : list_(*ImGui::GetBackgroundDrawList()), place_(place), film_(film) {
        list_.PushClipRect({place.x, place.y}, {place.x + place.width, place.y + place.height});
    }
    ~Overlay() { list_.PopClipRect(); }
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    void draw_wipe(double wipe) {
        const float x = place_.x + static_cast<float>(wipe) * place_.width;
        list_.AddLine({x, place_.y}, {x, place_.y + place_.height}, IM_COL32(255, 255, 255, 160), 1);
    }

    void draw_selection(const Viewer& viewer) {
        const auto handles = selected_handles(viewer);
        if (!handles) return;
        const scene::Camera camera = viewer.state.camera.camera();
        draw(
            outline(viewer.state.edits.placed(viewer.session.loaded(), *viewer.state.selected_light), camera),
            kOutlineColour, 2);
        for (const Handle& handle : kHandles) {
            const FilmLines lines = handles->lines(handle, camera);
            const ImU32 colour =
                viewer.pointer.handle() == handle ? kActiveColour : kAxisColours[handle.axis];
            const bool is_arrow = handle.action == HandleAction::move;
            draw(lines, colour, is_arrow ? 3.0f : 1.5f);
            if (is_arrow && !lines.empty()) list_.AddCircleFilled(in_window(lines.back().second), 5, colour);
        }
    }

private:
    ImVec2 in_window(FilmPosition at) const {
        return {place_.x + place_.width * static_cast<float>(at.x / film_.width),
                place_.y + place_.height * static_cast<float>(at.y / film_.height)};
    }

    void draw(const FilmLines& lines, ImU32 colour, float thickness) {
        for (const auto& [begin, end] : lines)
            list_.AddLine(in_window(begin), in_window(end), colour, thickness);
    }

    ImDrawList& list_;
    PicturePlace place_;
    const scene::Film& film_;
};

} // namespace

bool Controls::goes_down(const Window& window, int key) {
    if (window.is_key_down(key)) return keys_down_.insert(key).second;
    keys_down_.erase(key);
    return false;
}

void Controls::use_shortcuts(const Window& window, Viewer& viewer) {
    const ImGuiIO& io = ImGui::GetIO();
    if (goes_down(window, GLFW_KEY_F1)) viewer.shows_panel = !viewer.shows_panel;
    const bool is_undo = goes_down(window, GLFW_KEY_Z) && io.KeyCtrl;
    const bool is_removal = goes_down(window, GLFW_KEY_DELETE) && viewer.state.selected_light;
    if (io.WantTextInput) return;
    if (is_undo) io.KeyShift ? viewer.redo() : viewer.undo();
    if (is_removal) viewer.remove_selected_light();
}

void Controls::fly(const Window& window, Viewer& viewer) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureKeyboard || io.KeyCtrl) return;
    const double step = std::min(static_cast<double>(io.DeltaTime), kLongestTimeStep) * speed_ * kSpeed *
                        viewer.session.loaded().radius * (io.KeyShift ? 4 : 1);
    const scene::Double3 way = {axis(window, GLFW_KEY_D, GLFW_KEY_A), axis(window, GLFW_KEY_Q, GLFW_KEY_E),
                                axis(window, GLFW_KEY_W, GLFW_KEY_S)};
    if (length(way) == 0) return;
    viewer.state.camera.move(step * way);
    viewer.is_moving = true;
}

void Controls::look(Viewer& viewer) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) is_orbiting_ = false;
    if (io.WantCaptureMouse) return;
    const double x = kTurnPerPixel * static_cast<double>(io.MouseDelta.x);
    const double y = kTurnPerPixel * static_cast<double>(io.MouseDelta.y);
    if (x != 0 || y != 0) {
        if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
            viewer.state.camera.turn(x, -y);
            viewer.is_moving = true;
        } else if (is_orbiting_ || ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
            viewer.orbit(-x, y);
            viewer.is_moving = true;
        }
    }
    if (io.MouseWheel != 0) speed_ *= std::pow(kSpeedOfWheel, static_cast<double>(io.MouseWheel));
    speed_ = std::clamp(speed_, 1e-3, 1e3);
}

void Controls::point(const PicturePlace& place, Viewer& viewer) {
    const ImGuiIO& io = ImGui::GetIO();
    const scene::Film& film = viewer.session.loaded().film;
    const FilmPosition at = film_position(place, io.MousePos, film);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.WantCaptureMouse) {
        if (io.KeyAlt)
            is_orbiting_ = true;
        else
            viewer.pointer.press(at, film.width / static_cast<double>(place.width), viewer);
    }
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) viewer.pointer.move_to(at, viewer);
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left)) viewer.pointer.release(viewer);
}

void Controls::apply(const Window& window, const PicturePlace& place, Viewer& viewer) {
    use_shortcuts(window, viewer);
    fly(window, viewer);
    point(place, viewer);
    look(viewer);
    Overlay overlay(place, viewer.session.loaded().film);
    if (viewer.state.is_split) overlay.draw_wipe(viewer.state.wipe);
    overlay.draw_selection(viewer);
}

} // namespace nusselt::viewer
