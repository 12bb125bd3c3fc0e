#pragma once
/// Runs scripts of the viewer without a window.

#include "base/temporary_folder.h"
#include "common/source_folder.h"
#include "viewer/script/script.h"

#include "gpu_test.h"

#include "render/film.h"
#include "scene/import/importers.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace nusselt::viewer {

class ScriptTest : public parity::GpuTest {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string write_file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return path(name);
    }

    std::string write(const std::string& text) const { return write_file("script.txt", text); }

    Viewer make_viewer(const render::RenderSettings& settings = {}) const {
        scene::Scene scene = scene::load_scene(std::filesystem::path(nusselt_test::kSourceFolder) /
                                               "scenes/cornell-panel.pbrt");
        render::resize_film(scene, 24, 20);
        return {
            device(), scene, render_vulkan::ShadowRays::bvh, settings, {"cornell-panel.pbrt", {}, {}, {}}};
    }

    /// Runs a script like the loop of the window. \returns the number of frames
    static int play(const std::string& script_path, Viewer& viewer) {
        Script script{std::filesystem::path(script_path)};
        int frames = 0;
        for (script.advance(viewer); !viewer.is_closing && frames < 1000; script.advance(viewer)) {
            viewer.next_frame();
            ++frames;
        }
        return frames;
    }

    /// The error message of a script.
    std::string error_of(const std::string& text, Viewer& viewer) const {
        try {
            play(write(text), viewer);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "none";
    }

private:
    nusselt::base::TemporaryFolder folder_;
};

} // namespace nusselt::viewer
