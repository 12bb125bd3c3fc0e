#include "map.h"
#include "apps/common/validators.h"

#include "base/atomic_file.h"
#include "lab/figures/sampling_map.h"

#include <CLI/CLI.hpp>

#include <fstream>
#include <memory>

namespace nusselt::app {

void setup_map(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<MapOptions>();
    CLI::App* command =
        app.add_subcommand("map", "Draw how a technique maps random numbers to a light, as SVG.");
    command->add_option("TECHNIQUE", options->technique, "Class name")
        ->required()
        ->transform(to_one_of(lab::mapped_techniques()));
    command->add_option("FILE", options->output, "SVG file to write")
        ->required()
        ->check([](const std::string& name) {
            return std::filesystem::path(name).extension() == ".svg"
                       ? std::string()
                       : "'" + name + "' must be the name of an SVG file, with .svg";
        });
    command->callback([options, &exit_code] { exit_code = run_map(*options); });
}

int run_map(const MapOptions& options) {
    base::check_writable(options.output);
    const std::string picture = lab::draw_sampling_map(options.technique);
    base::write_atomically(options.output, [&](std::ofstream& file) { file << picture; });
    return 0;
}

} // namespace nusselt::app
