#include "run_viewer.h"

#include "controls.h"
#include "panels.h"
#include "window.h"

#include "image/io.h"
#include "viewer/script/script.h"

#include <algorithm>

namespace nusselt::viewer {

namespace {

// There is room for panels, however small the image is.
constexpr int kSmallestWidth = 960;
constexpr int kSmallestHeight = 720;
/// How long input may have to wait [s] on slow devices.
constexpr double kFrameSeconds = 0.1;

} // namespace

void run_viewer(Viewer& viewer, const std::optional<std::filesystem::path>& script_path) {
    Script script = script_path ? Script(*script_path) : Script();
    const scene::Film& film = viewer.session.loaded().film;
    Window window("Nusselt: " + viewer.files.scene.filename().string(),
                  std::max(film.width + static_cast<int>(kPanelWidth), kSmallestWidth),
                  std::max(film.height, kSmallestHeight));
    Panels panels;
    Controls controls;
    while (!window.is_closing()) {
        script.advance(viewer);
        if (viewer.is_closing) break;
        viewer.next_frame(kFrameSeconds);
        const float panel_width = viewer.shows_panel ? kPanelWidth : 0;
        window.show(viewer.session.picture(), film.width, film.height, panel_width,
                    [&](const PicturePlace& place) {
                        controls.apply(window, place, viewer);
                        panels.draw(viewer);
                    });
        if (viewer.window_screenshot) {
            image::write_image(*viewer.window_screenshot, window.contents());
            viewer.window_screenshot.reset();
        }
    }
}

} // namespace nusselt::viewer
