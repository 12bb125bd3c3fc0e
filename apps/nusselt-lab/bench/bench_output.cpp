#include "bench_output.h"

#include "apps/common/help.h"
#include "apps/common/validators.h"
#include "base/atomic_file.h"
#include "base/file_checks.h"
#include "base/json_output.h"
#include "lab/report/run_settings.h"
#include "scene/import/importers.h"

#include <algorithm>

namespace nusselt::app {

void add_repetitions_option(CLI::App& command, int& repetitions) {
    command.add_option("--repetitions", repetitions, "Interleaved repetitions; the median is reported")
        ->transform(to_whole_number(1, 10001));
}

void add_json_option(CLI::App& command, std::optional<std::string>& json) {
    command
        .add_option("--json", json,
                    "Write the numbers as JSON to this file, or with - to the standard output")
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kOutputGroup);
}

void check_json_option(const std::optional<std::string>& file,
                       const std::vector<std::filesystem::path>& inputs) {
    if (!file || *file == "-") return;
    base::check_writable(*file);
    base::check_distinct({*file}, inputs);
}

scene::Scene load_scene(const std::filesystem::path& path, const std::optional<std::string>& json) {
    check_json_option(json, {path}); // before the time that loading takes
    scene::Scene scene = scene::load_scene(path);
    check_json_option(json, scene.files);
    if (scene.lights.empty())
        throw std::runtime_error("the scene has no lights; there is nothing to measure");
    return scene;
}

void add_scenes_options(CLI::App& command, std::vector<std::filesystem::path>& scenes,
                        std::filesystem::path& folder) {
    command.add_option("SCENES", scenes, "Scene files")
        ->default_str("all of --scenes, and bathroom/bathroom.pbrt in the folder that the environment "
                      "variable NUSSELT_SCENES names");
    command.add_option("--scenes", folder, "Folder with the shipped scenes")->type_name("FOLDER");
}

std::vector<std::filesystem::path> shipped_scenes(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder))
        throw std::runtime_error(
            "missing folder '" + folder.string() +
            "'; run in the repository, name the folder of the shipped scenes with --scenes, or name scenes");
    std::vector<std::filesystem::path> scenes;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".pbrt") scenes.push_back(entry.path());
    std::sort(scenes.begin(), scenes.end());
    if (const auto published = lab::published_scenes())
        scenes.push_back(*published / "bathroom" / "bathroom.pbrt");
    return scenes;
}

void write_results(const std::optional<std::string>& file, const lab::Results& results,
                   const std::function<void()>& print_table) {
    if (file != "-") print_table();
    if (file) base::write_json(*file, to_json(results));
}

} // namespace nusselt::app
