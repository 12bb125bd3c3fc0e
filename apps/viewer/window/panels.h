#pragma once
/// The panel of the viewer.

#include "viewer/viewer.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace nusselt::viewer {

class Panels {
public:
    /// Describes the panel to Dear ImGui, or a button that shows it, and carries out the actions of the user there.
    void draw(Viewer& viewer);

private:
    void draw_settings(Viewer& viewer);
    void draw_lights(Viewer& viewer);
    void draw_selected_light(Viewer& viewer);
    /// \param note takes whether the last control changed the edit
    /// \returns whether a file was read
    bool draw_light_files(Viewer& viewer, const std::function<void(bool)>& note);
    void draw_files(Viewer& viewer);

    std::string file_ = "view.png";
    std::optional<std::size_t> last_light_; ///< selected in the last frame
    // The edit of the selected light while the user changes it.
    std::optional<std::size_t> edited_light_;
    LightEdit edit_;
    std::string light_file_; ///< a profile, an image or a map
    std::string command_;    ///< that renders the last screenshot
};

} // namespace nusselt::viewer
