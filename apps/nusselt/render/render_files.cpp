#include "render_files.h"

#include "apps/common/render_setup.h"
#include "base/file_checks.h"

#include "base/atomic_file.h"
#include "image/io.h"

#include <fmt/core.h>

#include <optional>
#include <string>
#include <system_error>

namespace nusselt::app {

std::vector<std::filesystem::path> output_paths(const RenderOptions& options, const scene::Film& film) {
    if (!options.outputs.empty()) return options.outputs;
    std::string stem = std::filesystem::path(film.filename).stem().string();
    if (stem.empty()) stem = options.scene.stem().string();
    if (const auto part = options.part ? parse_part(*options.part) : std::nullopt)
        stem += fmt::format("-{}of{}", part->number, part->count);
    return {stem + ".exr"};
}

std::vector<std::filesystem::path> input_paths(const RenderOptions& options) {
    std::vector<std::filesystem::path> inputs = {options.scene};
    inputs.insert(inputs.end(), options.rigs.begin(), options.rigs.end());
    if (options.camera) inputs.push_back(*options.camera);
    return inputs;
}

void check_outputs(const RenderOptions& options) {
    // The name that the scene may give to the default image is unknown yet, its folder is not. If there is no scene, that
    // is the problem.
    std::error_code ignored;
    const bool has_names =
        !options.outputs.empty() || std::filesystem::is_regular_file(options.scene, ignored);
    if (has_names)
        for (const std::filesystem::path& path : output_paths(options, scene::Film()))
            image::check_writable_image(path);
    if (options.json && options.json != "-") base::check_writable(*options.json);
    if (options.checkpoint) base::check_writable(*options.checkpoint);
}

void check_names(const RenderOptions& options, const scene::Scene& scene) {
    std::vector<std::filesystem::path> outputs = output_paths(options, scene.film);
    if (options.json && options.json != "-") outputs.emplace_back(*options.json);
    if (options.checkpoint) outputs.push_back(*options.checkpoint);
    std::vector<std::filesystem::path> inputs = scene.files;
    const std::vector<std::filesystem::path> named = input_paths(options);
    inputs.insert(inputs.end(), named.begin(), named.end());
    base::check_distinct(outputs, inputs);
}

void print_output(const RenderOptions& options, const std::filesystem::path& path) {
    if (!options.quiet && options.json != "-") fmt::print("{}\n", path.string());
}

} // namespace nusselt::app
