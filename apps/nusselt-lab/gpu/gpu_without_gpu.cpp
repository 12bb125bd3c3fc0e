#include "apps/nusselt-lab/gpu/gpu.h"

#include <CLI/CLI.hpp>

#include <stdexcept>

namespace nusselt::app {

namespace {

void add_missing(CLI::App& gpu, const char* name, const char* description) {
    CLI::App* command = gpu.add_subcommand(name, description);
    command->allow_extras();
    command->callback([] {
        throw std::runtime_error("this program was built without GPU support; install libvulkan-dev and "
                                 "glslang-tools, then configure and build again");
    });
}

} // namespace

void setup_gpu_device(CLI::App& gpu, int&) {
    add_missing(gpu, "device", "What the device supports (not in this build).");
}

void setup_gpu_parity(CLI::App& gpu, int&) {
    add_missing(gpu, "parity", "Errors of the device (not in this build).");
}

void setup_gpu_agreement(CLI::App& gpu, int&) {
    add_missing(gpu, "agreement", "Images of the device (not in this build).");
}

} // namespace nusselt::app
