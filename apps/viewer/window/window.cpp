#include "window.h"

#include "image/srgb.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace nusselt::viewer {

namespace {

/// The last error message of GLFW.
std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown reason";
}

[[noreturn]] void fail_without_display(const std::string& reason) {
    const bool has_display = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
    throw std::runtime_error("no window can be opened (" +
                             (has_display ? reason : "neither DISPLAY nor WAYLAND_DISPLAY is set") +
                             "); without a display, use `nusselt render SCENE --backend auto -o image.png`");
}

/// OpenGL 1.1, which is not linked: programs open the library of the display at run time.
struct OpenGl {
    decltype(&glGenTextures) gen_textures = find<decltype(&glGenTextures)>("glGenTextures");
    decltype(&glDeleteTextures) delete_textures = find<decltype(&glDeleteTextures)>("glDeleteTextures");
    decltype(&glBindTexture) bind_texture = find<decltype(&glBindTexture)>("glBindTexture");
    decltype(&glTexParameteri) tex_parameter = find<decltype(&glTexParameteri)>("glTexParameteri");
    decltype(&glTexImage2D) tex_image = find<decltype(&glTexImage2D)>("glTexImage2D");
    decltype(&glTexSubImage2D) tex_sub_image = find<decltype(&glTexSubImage2D)>("glTexSubImage2D");
    decltype(&glViewport) viewport = find<decltype(&glViewport)>("glViewport");
    decltype(&glClearColor) clear_color = find<decltype(&glClearColor)>("glClearColor");
    decltype(&glReadPixels) read_pixels = find<decltype(&glReadPixels)>("glReadPixels");
    decltype(&glClear) clear = find<decltype(&glClear)>("glClear");

private:
    template <class Function>
    static Function find(const char* name) {
        const auto function = reinterpret_cast<Function>(glfwGetProcAddress(name));
        if (function == nullptr) fail_without_display(std::string("OpenGL lacks ") + name);
        return function;
    }
};

GLFWwindow* make_window(const std::string& title, int width, int height) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    if (GLFWmonitor* const monitor = glfwGetPrimaryMonitor()) {
        int x = 0, y = 0, free_width = width, free_height = height;
        glfwGetMonitorWorkarea(monitor, &x, &y, &free_width, &free_height);
        width = std::clamp(width, 1, std::max(free_width, 1));
        height = std::clamp(height, 1, std::max(free_height, 1));
    }
    GLFWwindow* const window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window == nullptr) fail_without_display(last_error());
    glfwMakeContextCurrent(window);
    // Frames of the renderer set the pace.
    glfwSwapInterval(0);
    return window;
}

/// The largest place beside the panel.
PicturePlace place_of(float width, float height, float panel_width, const ImVec2& window) {
    const float free_width = std::max(window.x - panel_width, 1.0f);
    float scale = std::min(free_width / width, window.y / height);
    // Enlarged by a whole number, all pixels have the same size.
    if (scale > 1) scale = std::floor(scale);
    return {panel_width + (free_width - scale * width) / 2, (window.y - scale * height) / 2, scale * width,
            scale * height};
}

} // namespace

struct Window::Library {
    Library() {
        if (glfwInit() == 0) fail_without_display(last_error());
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

struct Window::Gui {
    explicit Gui(GLFWwindow* window) {
        ImGui::CreateContext();
        // Nothing is written beside the scene.
        ImGui::GetIO().IniFilename = nullptr;
        ImGui_ImplGlfw_InitForOpenGL(window, true);
        ImGui_ImplOpenGL3_Init("#version 130");
    }
    ~Gui() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;
};

struct Window::Texture {
    Texture() { gl.gen_textures(1, &name); }
    ~Texture() { gl.delete_textures(1, &name); }
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    void fill(const render_vulkan::DisplayPass& picture) {
        const auto picture_width = static_cast<GLsizei>(picture.width());
        const auto picture_height = static_cast<GLsizei>(picture.height());
        gl.bind_texture(GL_TEXTURE_2D, name);
        if (picture_width != width || picture_height != height) {
            width = picture_width;
            height = picture_height;
            gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
            // Pixels stay visible when they are enlarged.
            gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
            gl.tex_image(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                         picture.pixels().data());
        } else {
            gl.tex_sub_image(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                             picture.pixels().data());
        }
    }

    OpenGl gl;
    GLuint name = 0;
    GLsizei width = 0, height = 0;
};

Window::Window(const std::string& title, int width, int height)
    : library_(std::make_unique<Library>()),
      window_(make_window(title, width, height)),
      gui_(std::make_unique<Gui>(window_)),
      texture_(std::make_unique<Texture>()) {}

Window::~Window() = default;

bool Window::is_closing() const { return glfwWindowShouldClose(window_) != 0; }

bool Window::is_key_down(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

void Window::show(const render_vulkan::DisplayPass& picture, int width, int height, float panel_width,
                  const std::function<void(const PicturePlace&)>& draw_panels) {
    glfwPollEvents();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    texture_->fill(picture);
    const PicturePlace place = place_of(static_cast<float>(width), static_cast<float>(height), panel_width,
                                        ImGui::GetIO().DisplaySize);
    ImGui::GetBackgroundDrawList()->AddImage(
        (ImTextureID)(std::uintptr_t)texture_->name, // a pointer or a number, as the version has it
        {place.x, place.y}, {place.x + place.width, place.y + place.height});
    draw_panels(place);
    ImGui::Render();
    draw();
    glfwSwapBuffers(window_);
}

void Window::draw() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    texture_->gl.viewport(0, 0, width, height);
    texture_->gl.clear_color(0.1f, 0.1f, 0.1f, 1);
    texture_->gl.clear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

image::Image Window::contents() const {
    // After it was shown, the buffer has no defined contents.
    draw();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    std::vector<std::uint8_t> codes(std::size_t{4} * static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
    texture_->gl.read_pixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, codes.data());
    image::Image image = image::make_image(width, height);
    // OpenGL counts rows from the bottom.
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const std::size_t row = i / 3 / static_cast<std::size_t>(width);
        const std::size_t column = i / 3 % static_cast<std::size_t>(width);
        const std::size_t from =
            (static_cast<std::size_t>(height) - 1 - row) * static_cast<std::size_t>(width);
        image.pixels[i] =
            static_cast<float>(image::linear_from_srgb(codes[4 * (from + column) + i % 3] / 255.0));
    }
    return image;
}

} // namespace nusselt::viewer
