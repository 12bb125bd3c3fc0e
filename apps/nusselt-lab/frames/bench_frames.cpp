#include "bench_frames.h"

#include "apps/common/render_setup.h"

namespace nusselt::app {

void add_frame_options(CLI::App& command, BenchFramesOptions& options, const std::string& samples_of) {
    command.add_option("SCENE", options.scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    command.add_option("--spp", options.samples, "Samples per " + samples_of + ", 1 to 64")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command.add_option("--repetitions", options.repetitions, "Runs of each kind, 1 to 1000")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    add_machine_options(command, options.threads, options.isa);
    add_resolution_option(command, options.resolution);
}

} // namespace nusselt::app
