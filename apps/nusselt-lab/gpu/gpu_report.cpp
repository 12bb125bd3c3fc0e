#include "apps/common/help.h"
#include "apps/nusselt-lab/gpu/gpu.h"

#include "base/atomic_file.h"
#include "lab/gpu_report/gpu_report.h"

#include <CLI/CLI.hpp>

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <memory>

namespace nusselt::app {

namespace {

struct Options {
    std::filesystem::path folder, manifest;
};

int run(const Options& options) {
    const lab::GpuReport report = lab::report_on_gpu(options.folder, options.manifest);
    const auto write = [&](const char* name, const std::string& text) {
        base::write_atomically(options.folder / name, [&](std::ofstream& file) { file << text; });
    };
    write("report.json", report.json);
    write("report.md", report.markdown);
    return report.passes ? 0 : 1;
}

} // namespace

void setup_gpu_report(CLI::App& gpu, int& exit_code) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = gpu.add_subcommand(
        "report",
        "Write report.json and report.md, a page with tables, from the results that run.sh of the kit for "
        "machines with a GPU left in a folder. Exits with 1 unless all steps passed.");
    command->add_option("FOLDER", options->folder, "Folder with steps.txt and the results")->required();
    command->add_option("--manifest", options->manifest, "File that describes the program")
        ->type_name("FILE")
        ->default_str(kNone);
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

} // namespace nusselt::app
