#pragma once
/// A window with a picture and panels.

#include "image/image.h"
#include "render_vulkan/display_pass.h"

#include <functional>
#include <memory>
#include <string>

struct GLFWwindow;

namespace nusselt::viewer {

/// The width of the panel at the left of the window [pixels].
inline constexpr float kPanelWidth = 350;

/// The place of the picture in the window [pixels of the window].
struct PicturePlace {
    float x = 0, y = 0, width = 1, height = 1;
};

/// One at a time. The picture is rendered by Vulkan, whichever device that is; the window shows it by OpenGL, whichever
/// device has the display.
class Window {
public:
    /// \param width, height of its contents; smaller on smaller displays
    /// \throws std::runtime_error if there is no display or it cannot do OpenGL 3
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool is_closing() const; ///< the person closed it

    /// \param key GLFW_KEY_W and the like
    bool is_key_down(int key) const;

    /// Handles input, lets `draw_panels` describe panels with Dear ImGui, and shows them beside the picture, which is as
    /// large as the rest of the window allows; if there is room, by a whole factor.
    /// \param width, height that the picture stands for; it may have fewer pixels
    /// \param panel_width of the window that the picture leaves free at its left [pixels]
    void show(const render_vulkan::DisplayPass& picture, int width, int height, float panel_width,
              const std::function<void(const PicturePlace&)>& draw_panels);

    /// What the last show() has drawn, panels included.
    image::Image contents() const;

private:
    void draw() const;

    struct Library; ///< GLFW
    struct Gui;     ///< Dear ImGui
    struct Texture; ///< of the picture

    std::unique_ptr<Library> library_;
    GLFWwindow* window_;
    std::unique_ptr<Gui> gui_;
    std::unique_ptr<Texture> texture_;
};

} // namespace nusselt::viewer
