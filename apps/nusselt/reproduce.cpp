#include "commands.h"
#include "render_setup.h"

#include "experiments/run.h"
#include "image/atomic_file.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

using experiments::Experiment;
using experiments::ExperimentResult;

void print_list() {
    for (const Experiment& e : experiments::all_experiments())
        fmt::print("{:<18}{}\n{:<18}{}\n", e.name, e.source, "", e.description);
}

std::vector<const Experiment*> selected(const std::vector<std::string>& names) {
    std::vector<const Experiment*> result;
    for (const Experiment& e : experiments::all_experiments())
        if (names.empty() || std::find(names.begin(), names.end(), e.name) != names.end())
            result.push_back(&e);
    return result;
}

void print_table(const ExperimentResult& result) {
    fmt::print("\n{}: {}\n{:.1f} % of the pixels outside penumbrae, mean radiance {:.4g}\n\n",
               result.experiment->name, result.experiment->source, 100 * result.share_outside_penumbrae,
               result.mean);
    fmt::print("{:<32}{:>12}{:>28}{:>10}{:>10}\n", "technique", "RMSE", "outside penumbrae / mean", "invalid",
               "seconds");
    for (const auto& v : result.variants)
        fmt::print("{:<32}{:>12.4g}{:>28.3g}{:>10}{:>10.3f}\n", v.label, v.rmse, v.rmse_outside_penumbrae,
                   v.invalid_pixels, v.seconds);
    for (const auto& e : result.expectations)
        fmt::print("{}: {}\n", e.holds ? "holds" : "DOES NOT HOLD", e.text);
}

void write_index(const std::filesystem::path& folder, const std::vector<const Experiment*>& experiments) {
    image::write_atomically(folder / "index.html", [&](std::ofstream& file) {
        file << "<!DOCTYPE html>\n<meta charset=\"utf-8\"><title>Nusselt: experiments</title>\n<ul>\n";
        for (const Experiment* e : experiments)
            file << fmt::format("<li><a href=\"{0}/index.html\">{0}</a>: {1}\n", e->name, e->source);
        file << "</ul>\n";
    });
}

} // namespace

void setup_reproduce(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<ReproduceOptions>();
    CLI::App* command = app.add_subcommand(
        "reproduce",
        "Render the comparisons of the papers and check what they claim. Prints a table and writes a\n"
        "page with all images for each experiment. The exit code is 1 if an expectation fails.");
    std::vector<std::string> names;
    for (const Experiment& e : experiments::all_experiments()) names.push_back(e.name);
    command->add_option("EXPERIMENT", options->experiments, "Names of experiments, see --list. Default: all")
        ->check(CLI::IsMember(names));
    command->add_flag_callback(
        "--list",
        [] {
            print_list();
            throw CLI::Success();
        },
        "List the experiments and exit");
    command->add_option("-o,--output", options->output, "Folder for the pages, created if missing")
        ->capture_default_str();
    command->add_option("--scenes", options->scenes, "Folder with the shipped scenes")->capture_default_str();
    command
        ->add_option("--reference-spp", options->reference_samples,
                     "Samples per pixel and light of references, 1 to 2^20. Default: as each experiment says")
        ->check(CLI::Range(1, render_cpu::kMaxSamples));
    command
        ->add_option("--width", options->width,
                     "Width of the images in pixels, 1 to 16384. Default: as each scene says")
        ->check(CLI::Range(1, 16384));
    command->add_option("--threads", options->threads, "Number of threads, 1 to 1024. Default: all cores")
        ->check(CLI::Range(1, 1024));
    command->callback([options, &exit_code] { exit_code = run_reproduce(*options); });
}

int run_reproduce(const ReproduceOptions& options) {
    if (!std::filesystem::is_directory(options.scenes))
        throw std::runtime_error(
            "no folder '" + options.scenes.string() +
            "': run in the repository or give the folder of the shipped scenes with --scenes");
    experiments::RunSettings settings;
    settings.scenes = options.scenes;
    settings.reference_samples = options.reference_samples;
    settings.width = options.width;
    settings.threads = options.threads.value_or(0);
    bool all_hold = true;
    const std::vector<const Experiment*> chosen = selected(options.experiments);
    for (const Experiment* experiment : chosen) {
        const ExperimentResult result =
            experiments::run_experiment(*experiment, settings, [&](std::string_view step) {
                fmt::print(stderr, "{}: {}\n", experiment->name, step);
            });
        print_table(result);
        experiments::write_report(result, options.output / experiment->name);
        for (const auto& e : result.expectations) all_hold = all_hold && e.holds;
    }
    write_index(options.output, chosen);
    fmt::print("\n{}\n", (options.output / "index.html").string());
    return all_hold ? 0 : 1;
}

} // namespace nusselt::app
