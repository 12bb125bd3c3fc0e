#include "merge.h"

#include "image/io.h"
#include "image/layers.h"
#include "render/merge.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>
#include <string>

namespace nusselt::app {

void setup_merge(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<MergeOptions>();
    CLI::App* command = app.add_subcommand(
        "merge",
        "Combine EXR files of `nusselt render`: parts of one image (--part), or images with different seeds\n"
        "(--seed). Pixels become means over all samples. Scene, size, layers and settings must be the same;\n"
        "samples that would count twice are an error.");
    const auto check_exr = [](const std::filesystem::path& path) {
        return image::is_exr(path) ? std::string()
                                   : "'" + path.string() + "' must be the name of an EXR file";
    };
    command->add_option("OUT", options->output, "EXR file to write")->required()->check(check_exr, "");
    command->add_option("IN", options->inputs, "EXR files to read, one or more")
        ->required()
        ->check(check_exr, "");
    command->callback([options, &exit_code] { exit_code = run_merge(*options); });
}

int run_merge(const MergeOptions& options) {
    image::check_writable_image(options.output);
    render::Merger merger;
    for (const std::filesystem::path& path : options.inputs) merger.add(image::read_layers(path), path);
    const image::LayeredImage result = merger.result();
    image::write_layers(options.output, result);
    if (const std::string& finished = result.metadata.at("finished_fraction"); finished != "1")
        fmt::print(stderr,
                   "warning: only a fraction of {} of the pixels has samples; add the missing parts\n",
                   finished);
    return 0;
}

} // namespace nusselt::app
