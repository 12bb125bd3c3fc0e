#include "render_files.h"

#include "apps/common/render_setup.h"

#include "image/io.h"

#include <fmt/core.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace nusselt::app {

std::vector<std::filesystem::path> output_paths(const RenderOptions& options, const scene::Film& film) {
    if (!options.outputs.empty()) return options.outputs;
    const bool is_named = !film.filename.empty();
    const std::filesystem::path name = is_named ? std::filesystem::path(film.filename) : options.scene;
    std::string stem = name.filename().stem().string();
    if (const auto part = options.part ? parse_part(*options.part) : std::nullopt)
        stem += fmt::format("-{}of{}", part->number, part->count);
    return {stem + ".exr"};
}

void check_outputs(const RenderOptions& options) {
    // The name that the scene may give to the default image is unknown yet, its folder is not.
    for (const std::filesystem::path& path : output_paths(options, scene::Film()))
        image::check_writable_image(path);
    if (options.json && options.json != "-") image::check_writable(*options.json);
    if (options.checkpoint) image::check_writable(*options.checkpoint);
}

void check_names(const RenderOptions& options, const scene::Film& film) {
    std::vector<std::filesystem::path> files = output_paths(options, film);
    if (options.json && options.json != "-") files.emplace_back(*options.json);
    if (options.checkpoint) files.push_back(*options.checkpoint);
    const std::size_t written = files.size();
    files.push_back(options.scene);
    if (options.camera) files.push_back(*options.camera);
    files.insert(files.end(), options.rigs.begin(), options.rigs.end());
    std::vector<std::filesystem::path> places;
    for (const std::filesystem::path& file : files)
        places.push_back(std::filesystem::weakly_canonical(absolute(file)));
    for (std::size_t i = 0; i < written; ++i)
        for (std::size_t j = i + 1; j < files.size(); ++j)
            if (places[i] == places[j])
                throw std::runtime_error("'" + files[i].string() + "' is an output and also " +
                                         (j < written ? "another output" : "an input") +
                                         "; change one of the names");
}

void print_outputs(const RenderOptions& options, const scene::Film& film) {
    if (options.quiet || options.json == "-") return;
    for (const std::filesystem::path& path : output_paths(options, film)) fmt::print("{}\n", path.string());
}

} // namespace nusselt::app
