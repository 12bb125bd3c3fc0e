// `nusselt view` as a user sees it: in a window, on a display without a screen.

#include "program.h"

#include "image/io.h"

#include <algorithm>

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

TEST_F(View, SaysWhatIsWrongWithAScript) {
    const std::string script = write("script.txt", "frames 1\nzoom 3\n");
    const Outcome viewed = run(kView + "--script '" + script + "'", kDisplay);
    EXPECT_EQ(viewed.exit_code, 1);
    expect_message(viewed.err, "script.txt:2: unknown command 'zoom'");
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
