// Renderings that are stopped, killed and continued.

#include "program.h"

#include "image/io.h"
#include "image/layers.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace nusselt {

namespace {

class RenderCheckpoint : public CommandLine {
protected:
    std::vector<std::string> arguments() const {
        std::vector<std::string> result = {"render",       kScenes + "/room.pbrt",
                                           "--resolution", "160x120",
                                           "--spp",        "48",
                                           "--layers",     "lights,depth",
                                           "--threads",    "2",
                                           "-q",           "-o",
                                           path("a.exr"),  "--checkpoint",
                                           path("state"),  "--checkpoint-interval",
                                           "0.02"};
        if (!rig_.empty()) result.insert(result.end(), {"--lights", rig_});
        return result;
    }

    /// A light rig for all renderings from now on.
    void set_rig(const std::string& name, const std::string& factor) {
        rig_ = path(name);
        std::ofstream(rig_) << R"({"version": 1, "lights": [{"light": "*", "scale_radiance": )" + factor +
                                   "}]}";
    }

    pid_t start() const { return start(arguments()); }
    /// \param messages the file for the standard error; empty: that of the test
    static pid_t start(const std::vector<std::string>& texts, const std::string& messages = "") {
        std::vector<char*> argv = {const_cast<char*>("nusselt")};
        for (const std::string& text : texts) argv.push_back(const_cast<char*>(text.c_str()));
        argv.push_back(nullptr);
        std::filesystem::remove(messages); // those of an earlier run would be taken for new ones
        const pid_t child = ::fork();
        if (child != 0) return child;
        if (!messages.empty() && std::freopen(messages.c_str(), "w", stderr) == nullptr) std::_Exit(126);
        ::execv(kProgram, argv.data());
        std::_Exit(127);
    }

    /// Starts the program and waits until it handles signals. What it has to load then should take long.
    pid_t start_loading(const std::vector<std::string>& texts) const {
        const pid_t child = start(texts, path("messages.txt"));
        const std::filesystem::path status = "/proc/" + std::to_string(child) + "/status";
        for (int i = 0; i < 10'000; ++i) {
            std::ifstream stream(status);
            std::uint64_t handled = 0; // signals, SIGHUP being the lowest bit
            for (std::string word; stream >> word;)
                if (word == "SigCgt:") stream >> std::hex >> handled;
            if ((handled >> (SIGTERM - 1) & 1) != 0) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return child;
    }

    static bool has_ended(pid_t child) {
        siginfo_t info{};
        return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               info.si_pid == child;
    }

    /// Waits until the program has written this file with this text in it, or has ended.
    void wait_for(pid_t child, const std::string& file, const std::string& text = "") const {
        const auto is_there = [&] {
            return std::filesystem::exists(path(file)) && read(file).find(text) != std::string::npos;
        };
        while (!is_there() && !has_ended(child)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

    /// Sends a signal. \returns what waitpid() says of the end
    static int status_after(pid_t child, int signal) {
        ::kill(child, signal);
        int status = 0;
        EXPECT_EQ(::waitpid(child, &status, 0), child);
        return status;
    }

    /// \returns the exit code, or -1 if a signal ended the program
    static int end(pid_t child, int signal) {
        const int status = status_after(child, signal);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    /// \returns 0 if the program ended by itself
    static int signal_that_ended(pid_t child, int signal) {
        const int status = status_after(child, signal);
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

    /// Ends the program by SIGTERM after some time. \returns how long that took
    static std::chrono::duration<double> terminate(pid_t child, std::chrono::milliseconds delay = {}) {
        std::this_thread::sleep_for(delay);
        const auto begin = std::chrono::steady_clock::now();
        EXPECT_EQ(end(child, SIGTERM), 143);
        return std::chrono::steady_clock::now() - begin;
    }

    /// Starts the rendering and sends it a signal once there is a checkpoint. On a busy machine, the image may be finished
    /// by then; in this case, it starts anew.
    int end_when_stored(int signal) const {
        int code = 0;
        for (int i = 0; i < 20 && code == 0; ++i) {
            const pid_t child = start();
            wait_for(child, "state");
            code = end(child, signal);
        }
        return code;
    }

    std::string command() const {
        std::string result;
        for (const std::string& text : arguments()) result += "'" + text + "' ";
        return result;
    }

    /// The image that a run without any interruption writes.
    image::LayeredImage whole() const {
        EXPECT_EQ(run("render '" + kScenes +
                      "/room.pbrt' --resolution 160x120 --spp 48 --layers lights,depth -q -o whole.exr")
                      .exit_code,
                  0);
        return image::read_layers(path("whole.exr"));
    }

    void expect_same_image(const image::LayeredImage& expected) const {
        const image::LayeredImage image = image::read_layers(path("a.exr"));
        ASSERT_EQ(image.layers.size(), expected.layers.size());
        for (std::size_t i = 0; i < image.layers.size(); ++i)
            EXPECT_EQ(image.layers[i].data, expected.layers[i].data) << image.layers[i].name;
    }

private:
    std::string rig_;
};

TEST_F(RenderCheckpoint, KilledAtAnyTimeItGoesOnToTheSameImage) {
    const image::LayeredImage expected = whole();
    EXPECT_EQ(end_when_stored(SIGKILL), -1);
    EXPECT_GT(std::filesystem::file_size(path("state")), 16u * 16 * 3 * sizeof(float));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> delay(0.0, 0.4);
    for (int i = 0; i < 12; ++i) {
        const pid_t child = start();
        std::this_thread::sleep_for(std::chrono::duration<double>(delay(random)));
        end(child, SIGKILL);
        // Whenever an image is there, it is the right one.
        if (std::filesystem::exists(path("a.exr"))) expect_same_image(expected);
    }
    const Outcome last = run(command());
    EXPECT_EQ(last.exit_code, 0) << last.err;
    expect_same_image(expected);
    EXPECT_FALSE(std::filesystem::exists(path("state")));
}

/// Clusters send SIGTERM before they take a machine away, batch systems SIGXCPU or SIGUSR1 before a job has used up its
/// time, and terminals that are closed SIGHUP.
TEST_F(RenderCheckpoint, SignalsOfClustersAndTerminalsStoreAllThatIsFinished) {
    const image::LayeredImage expected = whole();
    for (const int signal : {SIGTERM, SIGHUP, SIGXCPU, SIGUSR1}) {
        std::filesystem::remove(path("state"));
        EXPECT_EQ(end_when_stored(signal), 128 + signal);
        EXPECT_TRUE(std::filesystem::exists(path("state")));
        EXPECT_LT(std::stod(image::read_exr_metadata(path("a.exr")).at("finished_fraction")), 1);
    }
    EXPECT_EQ(run(command()).exit_code, 0);
    expect_same_image(expected);
}

/// As closed terminals send it.
TEST_F(RenderCheckpoint, ASecondSighupDoesNotEndTheProgram) {
    int code = 0;
    for (int i = 0; i < 20 && code == 0; ++i) { // 0 if the image is finished before the first one
        const pid_t child = start();
        wait_for(child, "state");
        ::kill(child, SIGHUP);
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // otherwise both may arrive as one
        code = end(child, SIGHUP);
    }
    EXPECT_EQ(code, 129);
    EXPECT_TRUE(std::filesystem::exists(path("state")));
    EXPECT_TRUE(std::filesystem::exists(path("a.exr")));
}

/// Chance decides whether the second Ctrl-C arrives while the program stops: camera rays take some tenths of a second.
TEST_F(RenderCheckpoint, ASecondCtrlCEndsTheProgramAtOnce) {
    bool is_ended = false;
    for (int i = 1; i <= 20 && !is_ended; ++i) {
        const pid_t child = start({"render", kScenes + "/room.pbrt", "--resolution", "16x16", "--spp",
                                   "65536", "--camera-rays", "1", "--threads", "1", "-o", path("a.exr")},
                                  path("messages.txt"));
        std::this_thread::sleep_for(i * std::chrono::milliseconds(100));
        ::kill(child, SIGINT);
        wait_for(child, "messages.txt", "stop");
        is_ended = signal_that_ended(child, SIGINT) == SIGINT;
    }
    EXPECT_TRUE(is_ended);
    EXPECT_EQ(read("messages.txt"), "\nstopping; a second Ctrl-C ends the program at once\n");
}

TEST_F(RenderCheckpoint, CtrlCStoresAllThatIsFinished) {
    const image::LayeredImage expected = whole();
    EXPECT_EQ(end_when_stored(SIGINT), 130);
    EXPECT_TRUE(std::filesystem::exists(path("state")));
    const double finished = std::stod(image::read_exr_metadata(path("a.exr")).at("finished_fraction"));
    EXPECT_GT(finished, 0);
    EXPECT_LT(finished, 1);
    const image::LayeredImage stopped = image::read_layers(path("a.exr"));
    const image::Layer* const samples = image::find_layer(stopped, "samples");
    ASSERT_NE(samples, nullptr);
    const double taken = std::accumulate(samples->data.begin(), samples->data.end(), 0.0);
    EXPECT_NEAR(taken, finished * 160 * 120 * 48, 1);

    EXPECT_EQ(run(command()).exit_code, 0);
    expect_same_image(expected);
    EXPECT_FALSE(std::filesystem::exists(path("state")));
}

TEST_F(RenderCheckpoint, LinksStayAndTheFilesBehindThemGo) {
    std::filesystem::create_symlink("target", path("state"));
    EXPECT_EQ(run(command()).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(path("state")));
    EXPECT_FALSE(std::filesystem::exists(path("target")));
}

/// A tile takes longer than any of these runs.
TEST_F(RenderCheckpoint, RunsThatAreEndedEarlyGetOnWithinATile) {
    double before = 0;
    for (int i = 0; i < 3; ++i) {
        const pid_t child = start({"render", kScenes + "/room.pbrt", "--resolution", "16x16", "--spp",
                                   "1048576", "-q", "-o", path("a.exr"), "--checkpoint", path("state")});
        EXPECT_LT(terminate(child, std::chrono::milliseconds(800)).count(), 1);
        ASSERT_TRUE(std::filesystem::exists(path("a.exr")));
        const double finished = std::stod(image::read_exr_metadata(path("a.exr")).at("finished_fraction"));
        EXPECT_GT(finished, before);
        EXPECT_LT(finished, 1);
        before = finished;
    }
}

TEST_F(RenderCheckpoint, LoadingEndsAtOnce) {
    {
        std::ofstream scene(path("large.pbrt"));
        scene << "Camera \"perspective\"\nWorldBegin\nShape \"trianglemesh\" \"point3 P\" [\n";
        for (int i = 0; i < 3'000'000; ++i) scene << "0 0.25 1.5\n";
        scene << "] \"integer indices\" [0 1 2]\n";
    }
    const std::vector<std::string> render = {"render",      path("large.pbrt"), "-o",
                                             path("a.exr"), "--checkpoint",     path("state")};
    EXPECT_LT(terminate(start_loading(render)).count(), 1);
    EXPECT_EQ(read("messages.txt"), "stopped before rendering began; no image is written\n");
    EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
    EXPECT_FALSE(std::filesystem::exists(path("state")));

    std::ofstream(path("state")) << "of an earlier run";
    EXPECT_LT(terminate(start_loading(render)).count(), 1);
    EXPECT_EQ(read("messages.txt"), "stopped before rendering went on; the checkpoint stays as it was\n");
    EXPECT_EQ(read("state"), "of an earlier run");
}

/// Many large triangles keep Embree and the hierarchy for GPUs busy for seconds. The warning comes right before.
TEST_F(RenderCheckpoint, BuildingEndsAtOnce) {
    {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> coordinate(-1, 1);
        std::ofstream scene(path("large.pbrt"));
        scene << "Camera \"perspective\"\nWorldBegin\nShape \"trianglemesh\" \"point3 P\" [\n";
        for (int i = 0; i < 3 * 1000; ++i) scene << coordinate(random) << '\n';
        scene << "] \"integer indices\" [\n";
        for (int i = 0; i < 1'000'000; ++i)
            scene << i % 1000 << ' ' << (i / 1000 + 7 * i + 1) % 1000 << ' ' << (i / 7 + 3 * i) % 1000
                  << '\n';
        scene << "]\n";
    }
    std::ofstream(path("empty.pbrt")) << "";
    const Outcome device = run("render empty.pbrt --backend vulkan");
    for (const char* backend : {"cpu", "vulkan"}) {
        if (backend == std::string("vulkan") && lacks_device(device)) GTEST_SKIP() << device.err;
        const pid_t child = start({"render", path("large.pbrt"), "--backend", backend, "-o", path("a.exr")},
                                  path("messages.txt"));
        wait_for(child, "messages.txt", "the scene has no lights");
        EXPECT_LT(terminate(child, std::chrono::milliseconds(50)).count(), 1) << backend;
        EXPECT_NE(read("messages.txt").find("stopped before rendering began; no image is written\n"),
                  std::string::npos)
            << read("messages.txt");
        EXPECT_FALSE(std::filesystem::exists(path("a.exr"))) << backend;
    }
}

TEST_F(RenderCheckpoint, OfAnotherCommandIsRefused) {
    const std::string render =
        "render '" + kScenes + "/room.pbrt' --resolution 32x32 -q -o b.exr --checkpoint state";
    std::ofstream(path("state")) << "no checkpoint at all";
    const Outcome foreign = run(render);
    EXPECT_EQ(foreign.exit_code, 1);
    expect_message(foreign.err, "the file is not a checkpoint");

    std::filesystem::remove(path("state"));
    EXPECT_EQ(end_when_stored(SIGKILL), -1);
    const Outcome other = run(render);
    EXPECT_EQ(other.exit_code, 1);
    expect_message(other.err, "another run");
    EXPECT_TRUE(std::filesystem::exists(path("state")));
}

TEST_F(RenderCheckpoint, OfOtherLightsIsRefused) {
    set_rig("dim.json", "0.5");
    EXPECT_EQ(end_when_stored(SIGKILL), -1);
    set_rig("other.json", "0.5");
    expect_message(run(command()).err, "light_rigs is 'dim.json' in the file, but 'other.json' now");
    set_rig("dim.json", "0.25");
    expect_message(run(command()).err,
                   "' now; the scene, a file that it uses, its camera or a light rig has changed");
    set_rig("dim.json", "0.5");
    EXPECT_EQ(run(command()).exit_code, 0);
}

TEST_F(RenderCheckpoint, IsNoOutput) {
    const std::string render = "render '" + kScenes + "/room.pbrt' --resolution 16x16 -q ";
    for (const char* names : {"-o a.exr --checkpoint ./a.exr", "--checkpoint room.exr",
                              "-o a.exr --json state --checkpoint state"}) {
        const Outcome clash = run(render + names);
        EXPECT_EQ(clash.exit_code, 1) << names;
        expect_message(clash.err, "is an output and also another output");
    }
}

TEST_F(RenderCheckpoint, ThatCannotBeWrittenIsNoticedFirst) {
    // Before the scene is read: otherwise the missing scene would be the error.
    for (const char* file : {"no/such/folder/state", "."}) {
        const Outcome early = run(std::string("render no-such-scene.pbrt --checkpoint ") + file);
        EXPECT_EQ(early.exit_code, 1) << file;
        expect_message(early.err, "cannot write");
    }
}

} // namespace

} // namespace nusselt
