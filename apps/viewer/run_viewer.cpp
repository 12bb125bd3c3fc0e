#include "run_viewer.h"

#include "controls.h"
#include "panels.h"
#include "script.h"
#include "window.h"

#include <algorithm>

namespace nusselt::viewer {

namespace {

// There is room for panels, however small the image is.
constexpr int kSmallestWidth = 960;
constexpr int kSmallestHeight = 720;

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
        viewer.next_frame();
        window.show(viewer.session.picture(), [&](const PicturePlace& place) {
            controls.apply(window, place, viewer);
            if (controls.shows_panels()) panels.draw(viewer);
        });
    }
}

} // namespace nusselt::viewer
