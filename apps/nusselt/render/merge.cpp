#include "merge.h"

#include "apps/common/help.h"
#include "apps/common/path_list.h"
#include "apps/common/print_message.h"
#include "base/file_checks.h"
#include "base/words.h"

#include "image/io.h"
#include "image/layers.h"
#include "image/packed_tiles.h"
#include "render/merge.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <stdexcept>
#include <string>

namespace nusselt::app {

void setup_merge(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<MergeOptions>();
    CLI::App* command = app.add_subcommand(
        "merge", "Combine EXR files of `nusselt render`: parts of one image (--part), or images with "
                 "different seeds (--seed). Pixels become means over all samples. Scene, size, layers and "
                 "settings must be the same; samples that would count twice are an error.");
    const auto check_exr = [](const std::filesystem::path& path) {
        return image::is_exr(path) ? std::string()
                                   : "'" + path.string() + "' must be the name of an EXR file";
    };
    command->add_option("-o,--output", options->output, "EXR file to write")
        ->type_name("FILE")
        ->default_str("the first file of IN, an old form that the next version refuses")
        ->check(check_exr)
        ->group(kOutputGroup);
    command->add_option("IN", options->inputs, "EXR files to read, one or more; not required with --list")
        ->check(check_exr);
    add_list_option(*command, options->list, "EXR files");
    command
        ->add_flag("--partial", options->allows_partial,
                   "Write the image although pixels lack samples because parts are missing")
        ->group(kOutputGroup);
    command->callback([options, &exit_code] {
        if (options->list && !options->output) throw CLI::RequiredError("--output");
        if (options->inputs.empty() && !options->list) throw CLI::RequiredError("IN");
        const bool is_old_form = !options->output;
        if (is_old_form) {
            if (options->inputs.size() < 2) throw CLI::RequiredError("--output");
            options->output = options->inputs.front();
            options->inputs.erase(options->inputs.begin());
            // Who forgets -o would lose the first part.
            if (std::filesystem::exists(*options->output))
                throw CLI::ValidationError("merge OUT IN...",
                                           fmt::format("'{}' exists; use `merge -o OUT IN...` to replace it",
                                                       options->output->string()));
        }
        exit_code = run_merge(*options);
        if (is_old_form)
            print_message("warning: `merge OUT IN...` is deprecated; use `merge -o {} IN...`\n",
                          base::shell_word(options->output->string()));
    });
}

int run_merge(const MergeOptions& options) {
    const std::vector<std::filesystem::path> inputs = with_listed(options.inputs, options.list);
    base::check_distinct({*options.output}, inputs);
    image::check_writable_image(*options.output);
    base::check_exist(inputs);
    render::Merger merger;
    for (const std::filesystem::path& path : inputs) merger.add(image::read_packed_layers(path), path);
    const image::LayeredImage result = merger.result();
    const double finished = std::stod(result.metadata.at("finished_fraction"));
    if (finished < 1 && !options.allows_partial)
        throw std::runtime_error(fmt::format("only {:.1f} % of the pixels have samples: {}; add what is "
                                             "missing, or use --partial to write what is there",
                                             std::floor(1000 * finished) / 10, merger.what_is_missing()));
    image::write_layers(*options.output, result);
    return 0;
}

} // namespace nusselt::app
