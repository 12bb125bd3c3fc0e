// `nusselt view` as a user sees it: in a window, on a display without a screen.

#include "program.h"

#include "image/io.h"

#include <algorithm>
#include <functional>
#include <sstream>

namespace nusselt {

namespace {

/// Runs the program with a display of its own.
const std::string kDisplay = "xvfb-run --auto-servernum --server-args='-screen 0 1280x1024x24'";

class View : public CommandLine {
protected:
    void SetUp() override {
        const bool has_display = std::system("command -v xvfb-run >/dev/null 2>&1") == 0;
        const bool has_viewer = run("view").err.find("without the viewer") == std::string::npos;
        const char* const ci = std::getenv("CI");
        if (has_display && has_viewer) {
            const Outcome quick =
                run("view '" + kScenes + "/cornell-tube.pbrt' --script '" + write("quit.txt", "quit\n") + "'",
                    kDisplay);
            if (lacks_device(quick)) GTEST_SKIP() << quick.err;
            return;
        }
        if (ci != nullptr && std::string(ci) == "true") FAIL() << "no xvfb-run, or no viewer in the program";
        GTEST_SKIP() << "no xvfb-run, or no viewer in the program";
    }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name)) << text;
        return path(name);
    }
};

const std::string kView = "view '" + kScenes + "/cornell-tube.pbrt' --resolution 96x80 ";

TEST_F(View, IsDrivenByAScript) {
    const std::string script = write("script.txt", "frames 4\n"
                                                   "screenshot first.png\n"
                                                   "technique solid_angle\n"
                                                   "accumulate off\n"
                                                   "frames 2\n"
                                                   "screenshot second.png\n"
                                                   "screenshot second.exr\n"
                                                   "quit\n");
    const Outcome viewed = run(kView + "--script '" + script + "'", kDisplay);
    EXPECT_EQ(viewed.exit_code, 0) << viewed.err;
    const image::Image first = image::read_image(path("first.png"));
    const image::Image second = image::read_image(path("second.png"));
    EXPECT_EQ(first.width, 96);
    EXPECT_EQ(first.height, 80);
    EXPECT_NE(first.pixels, second.pixels);
    EXPECT_GT(*std::max_element(first.pixels.begin(), first.pixels.end()), 0.5f);

    // The printed command renders what was seen: that was a single frame.
    const std::string command = viewed.out.substr(viewed.out.rfind("nusselt render"));
    EXPECT_NE(command.find("--technique solid_angle"), std::string::npos) << command;
    const Outcome rendered = run(
        command.substr(std::string("nusselt ").size(), command.find('\n') - std::string("nusselt ").size()));
    EXPECT_EQ(rendered.exit_code, 0) << rendered.err;
    const Outcome compared = run("compare second.exr second-again.exr --max rmse=1e-4");
    EXPECT_EQ(compared.exit_code, 0) << compared.out << compared.err;
}

TEST_F(View, WarnsOfLightsThatAreSampledInAnotherWay) {
    const std::string view =
        "view '" + kScenes + "/street.pbrt' --script '" + write("quit.txt", "quit\n") + "'";
    const Outcome viewed = run(view, kDisplay);
    EXPECT_EQ(viewed.exit_code, 0) << viewed.err;
    EXPECT_NE(viewed.err.find("are sampled as with --emission-sampling measure"), std::string::npos)
        << viewed.err;
    EXPECT_EQ(run(view + " --quiet", kDisplay).err, "");
}

TEST_F(View, SaysWhatIsWrongWithAScript) {
    const std::string script = write("script.txt", "frames 1\nzoom 3\n");
    const Outcome viewed = run(kView + "--script '" + script + "'", kDisplay);
    EXPECT_EQ(viewed.exit_code, 1);
    expect_message(viewed.err, "script.txt:2: unknown command 'zoom'");
}

TEST_F(View, GoesOnWithoutAReference) {
    const std::string script = write("script.txt", "frames 1\nprint-errors\nscreenshot after.png\nquit\n");
    const Outcome viewed = run(kView + "--script '" + script + "'", kDisplay);
    EXPECT_EQ(viewed.exit_code, 0);
    expect_message(viewed.err, "script.txt:2: no reference to compare with; start one with `reference on`");
    EXPECT_EQ(image::read_image(path("after.png")).width, 96);
}

/// The number of pixels of a window in a range of columns for which a condition holds.
template <class Condition>
int count_pixels(const image::Image& window, int x_begin, int x_end, const Condition& condition) {
    int count = 0;
    for (int y = 0; y < window.height; ++y)
        for (int x = x_begin; x < x_end; ++x) {
            const float* const c =
                &window.pixels[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width) +
                                    static_cast<std::size_t>(x))];
            count += condition(c[0], c[1], c[2]) ? 1 : 0;
        }
    return count;
}

TEST_F(View, ShowsThePanelBesideTheImage_AndHandlesAtTheSelectedLight) {
    const std::string script = write("script.txt", "exposure -32\nframes 1\n"
                                                   "window-screenshot plain.png\n"
                                                   "light 0\nlight-move 0 -0.3 0\nframes 1\n"
                                                   "window-screenshot selected.png\n"
                                                   "panel off\nframes 1\n"
                                                   "window-screenshot hidden.png\n"
                                                   "quit\n");
    const Outcome viewed = run(
        "view '" + kScenes + "/cornell-tube.pbrt' --resolution 900x500 --script '" + script + "'", kDisplay);
    ASSERT_EQ(viewed.exit_code, 0) << viewed.err;
    const image::Image plain = image::read_image(path("plain.png"));
    const image::Image selected = image::read_image(path("selected.png"));
    const image::Image hidden = image::read_image(path("hidden.png"));
    constexpr int kPanelWidth = 350;
    // The image is black, the window around it is not, and the panel has white text.
    const auto is_black = [](float r, float g, float b) { return r + g + b == 0; };
    const auto is_white = [](float r, float g, float b) { return std::min({r, g, b}) > 0.9f; };
    EXPECT_EQ(count_pixels(plain, kPanelWidth, plain.width, is_black), 900 * 500) << "nothing covers it";
    EXPECT_EQ(count_pixels(plain, 0, kPanelWidth, is_black), 0);
    EXPECT_GT(count_pixels(plain, 0, kPanelWidth, is_white), 1000);
    EXPECT_LT(count_pixels(hidden, 0, kPanelWidth, is_white), 100);
    // The arrows and rings of the axes.
    const auto is_red = [](float r, float g, float b) { return r > 0.5f && g + b < 0.3f; };
    const auto is_green = [](float r, float g, float b) { return g > 0.5f && r + b < 0.4f; };
    for (const auto& is_colour : {std::function<bool(float, float, float)>(is_red),
                                  std::function<bool(float, float, float)>(is_green)}) {
        EXPECT_EQ(count_pixels(plain, kPanelWidth, plain.width, is_colour), 0);
        EXPECT_GT(count_pixels(selected, kPanelWidth, selected.width, is_colour), 50);
    }
}

TEST_F(View, RendersFewerPixelsWhileSomethingMoves) {
    const std::string script = write("script.txt", "frames 1\nframes 2\nprint-speed\n"
                                                   "turning 1 0\nframes 3\nframes 10\nprint-speed\n"
                                                   "turning 0 0\nframes 1\nscreenshot still.png\nquit\n");
    const Outcome viewed =
        run("view '" + kScenes + "/room.pbrt' --resolution 1280x720 --script '" + script + "'", kDisplay);
    ASSERT_EQ(viewed.exit_code, 0) << viewed.err;
    EXPECT_EQ(image::read_image(path("still.png")).width, 1280);
    std::istringstream lines(viewed.out);
    std::string words;
    double at_rest = 0, moving = 0;
    int width = 0, moving_width = 0;
    lines >> at_rest >> words >> words >> words >> width;
    EXPECT_EQ(width, 1280) << viewed.out;
    std::getline(lines, words);
    lines >> moving >> words >> words >> words >> moving_width;
    EXPECT_GT(moving_width, 0) << viewed.out;
    // Devices that take less than a tenth of a second at rest have no need to be faster. Others may become faster
    // themselves, for example when other programs end.
    if (at_rest < 5) {
        EXPECT_LT(moving_width, 1280) << viewed.out;
    }
    if (at_rest < 1) {
        EXPECT_GT(moving, 2 * at_rest) << viewed.out;
    }
}

TEST_F(View, OffersTheHeadlessCommandWithoutADisplay) {
    const Outcome viewed = run(kView, "env -u DISPLAY -u WAYLAND_DISPLAY");
    EXPECT_EQ(viewed.exit_code, 1);
    expect_message(viewed.err, "neither DISPLAY nor WAYLAND_DISPLAY is set");
    EXPECT_NE(viewed.err.find("nusselt render SCENE --backend auto"), std::string::npos);
}

TEST_F(View, NamesADeviceThatIsMissing) {
    const Outcome viewed = run(kView + "--device 'Voodoo 2'", kDisplay);
    EXPECT_EQ(viewed.exit_code, 1);
    expect_message(viewed.err, "unknown Vulkan device 'Voodoo 2'");
}

} // namespace

} // namespace nusselt
