#include "reproduce.h"
#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"

#include "base/atomic_file.h"
#include "lab/figures/noise_table.h"
#include "lab/figures/run.h"
#include "lab/lines/line_convergence.h"
#include "lab/lines/line_visibility.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

using lab::Experiment;
using lab::LineConvergence;
using lab::LineVisibility;
using lab::NoiseTable;

/// The fields that all kinds of experiments share.
struct Heading {
    std::string name;
    std::string source;
    std::string description;
};

std::vector<Heading> all_headings() {
    std::vector<Heading> headings;
    for (const Experiment& e : lab::all_experiments()) headings.push_back({e.name, e.source, e.description});
    for (const NoiseTable& t : lab::all_noise_tables()) headings.push_back({t.name, t.source, t.description});
    for (const LineConvergence& c : lab::all_line_convergences())
        headings.push_back({c.name, c.source, c.description});
    for (const LineVisibility& v : lab::all_line_visibilities())
        headings.push_back({v.name, v.source, v.description});
    return headings;
}

void print_list() {
    for (const Heading& h : all_headings())
        fmt::print("{:<18}{}\n{:<18}{}\n", h.name, h.source, "", h.description);
}

bool is_chosen(const ReproduceOptions& options, const std::string& name) {
    const std::vector<std::string>& names = options.experiments;
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Prints and writes the result of one experiment. \returns whether all expectations hold
template <class Result>
bool report(const Result& result, const std::filesystem::path& folder) {
    fmt::print("\n{}", lab::to_text(result));
    lab::write_report(result, folder);
    return std::all_of(result.expectations.begin(), result.expectations.end(),
                       [](const lab::ExpectationResult& e) { return e.holds; });
}

/// Finds out before hours of work whether the pages can be written.
void prepare_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error("cannot create the folder '" + folder.string() + "' (" + error.message() +
                                 "); choose another one with --output");
    base::check_writable(folder / "index.html");
}

void prepare_folders(const ReproduceOptions& options) {
    prepare_folder(options.output);
    for (const Heading& h : all_headings())
        if (is_chosen(options, h.name)) prepare_folder(options.output / h.name);
}

void write_index(const ReproduceOptions& options) {
    base::write_atomically(options.output / "index.html", [&](std::ofstream& file) {
        file << "<!DOCTYPE html>\n<meta charset=\"utf-8\"><title>Nusselt: experiments</title>\n<ul>\n";
        for (const Heading& h : all_headings())
            if (is_chosen(options, h.name))
                file << fmt::format("<li><a href=\"{0}/index.html\">{0}</a>: {1}\n", h.name, h.source);
        file << "</ul>\n";
    });
}

} // namespace

void setup_reproduce(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<ReproduceOptions>();
    CLI::App* command =
        app.add_subcommand("reproduce", "Render the comparisons of the papers and check their claims. Prints "
                                        "a table and writes a page with all images for each experiment. "
                                        "Exits with 1 if an expectation fails.");
    std::vector<std::string> names;
    for (const Heading& h : all_headings()) names.push_back(h.name);
    command->add_option("EXPERIMENT", options->experiments, "Names of experiments, see --list")
        ->transform(to_one_of(names))
        ->default_str("all");
    command->add_flag_callback(
        "--list",
        [] {
            print_list();
            throw CLI::Success();
        },
        "List the experiments and exit");
    command->add_option("--scenes", options->scenes, "Folder with the shipped scenes")->type_name("FOLDER");
    command
        ->add_option("--reference-spp", options->reference_samples,
                     "Samples per pixel and light of references")
        ->transform(to_whole_number(1, render::kMaxSamples))
        ->default_str("set by each experiment");
    command->add_option("--width", options->width, "Width of the images in pixels")
        ->transform(to_whole_number(1, 16384))
        ->default_str("set by each scene");
    command->add_option("-o,--output", options->output, "Folder for the pages, created if missing")
        ->type_name("FOLDER")
        ->group(kOutputGroup);
    add_threads_option(*command, options->threads);
    command->callback([options, &exit_code] { exit_code = run_reproduce(*options); });
}

int run_reproduce(const ReproduceOptions& options) {
    if (!std::filesystem::is_directory(options.scenes))
        throw std::runtime_error(
            "missing folder '" + options.scenes.string() +
            "'; run in the repository, or name the folder of the shipped scenes with --scenes");
    prepare_folders(options);
    lab::RunSettings settings;
    settings.scenes = options.scenes;
    settings.reference_samples = options.reference_samples;
    settings.width = options.width;
    settings.threads = render_cpu::checked_thread_count(options.threads);
    bool all_hold = true;
    const auto run_all = [&](const auto& all, const auto& run) {
        for (const auto& experiment : all) {
            if (!is_chosen(options, experiment.name)) continue;
            const auto result = run(experiment, settings, [&](std::string_view step) {
                print_message("{}: {}\n", experiment.name, step);
            });
            all_hold = report(result, options.output / experiment.name) && all_hold;
        }
    };
    run_all(lab::all_experiments(), lab::run_experiment);
    run_all(lab::all_line_convergences(), lab::run_line_convergence);
    run_all(lab::all_line_visibilities(), lab::run_line_visibility);
    for (const NoiseTable& table : lab::all_noise_tables())
        if (is_chosen(options, table.name))
            all_hold = report(lab::measure_noise(table), options.output / table.name) && all_hold;
    write_index(options);
    fmt::print("\n{}\n", (options.output / "index.html").string());
    return all_hold ? 0 : 1;
}

} // namespace nusselt::app
