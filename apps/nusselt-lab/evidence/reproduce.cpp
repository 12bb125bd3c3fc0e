#include "reproduce.h"
#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"

#include "base/isa.h"
#include "base/stopwatch.h"
#include "base/words.h"
#include "lab/report/report_folder.h"
#include "render_cpu/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

using lab::Effort;
using lab::Experiment;
using lab::Verdict;

void print_list() {
    std::size_t width = 0;
    for (const Experiment& e : lab::all_experiments()) width = std::max(width, e.name.size() + 2);
    for (const Experiment& e : lab::all_experiments())
        fmt::print("{:<{}}{}\n{:<{}}{}\n", e.name, width, e.source, "", width, e.description);
}

std::vector<Experiment> chosen(const std::vector<std::string>& names) {
    std::vector<Experiment> experiments;
    for (const Experiment& e : lab::all_experiments())
        if (names.empty() || std::find(names.begin(), names.end(), e.name) != names.end())
            experiments.push_back(e);
    return experiments;
}

std::string now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

std::string command_for(const Experiment& experiment, const ReproduceOptions& options) {
    std::string command = "nusselt-lab reproduce " + experiment.name;
    if (options.effort == Effort::full) command += " --full";
    if (options.scenes != "scenes") command += " --scenes " + base::shell_word(options.scenes.string());
    if (options.threads) command += fmt::format(" --threads {}", *options.threads);
    return command;
}

/// The steps of all experiments on standard error, with a bar on a terminal.
class Steps {
public:
    explicit Steps(std::size_t experiments) : count_(experiments) {}

    void begin(const Experiment& experiment) {
        name_ = experiment.name;
        ++number_;
    }
    void print(std::string_view step) {
        bar_.finish();
        print_message("[{}/{}] {}: {}\n", number_, count_, name_, step);
        bar_.update(static_cast<double>(number_ - 1) / static_cast<double>(count_));
    }
    void finish() { bar_.finish(); }

private:
    std::size_t count_;
    std::size_t number_ = 0;
    std::string name_;
    Progress bar_;
};

const char* text_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::holds:
        return "";
    case Verdict::fails:
        return "; AN EXPECTATION DOES NOT HOLD";
    case Verdict::not_evaluated:
        break;
    }
    return "; AN EXPECTATION WAS NOT EVALUATED";
}

Verdict run(const Experiment& experiment, const ReproduceOptions& options, const lab::RunSettings& settings,
            const lab::ReportFolder& folder, Steps& steps) {
    if (const std::string obstacle = experiment.obstacle(); !obstacle.empty()) {
        steps.print("not run: " + obstacle);
        // Whoever asks for everything means everything that this machine can do.
        return options.experiments.empty() ? Verdict::holds : Verdict::not_evaluated;
    }
    if (const auto kept = folder.kept(experiment, settings)) {
        steps.print("nothing has changed since " + kept->date + text_of(kept->verdict));
        return kept->verdict;
    }
    lab::RunRecord record = {command_for(experiment, options), now()};
    const base::Stopwatch stopwatch;
    const lab::Report report = experiment.run(settings, [&](std::string_view step) { steps.print(step); });
    record.seconds = stopwatch.seconds();
    steps.finish();
    folder.write(experiment, report, settings, record);
    fmt::print("\n{}: {}\n{}\n{}", experiment.name, experiment.source, experiment.description,
               lab::to_text(report));
    std::fflush(stdout); // messages about the next steps go to standard error
    return verdict_of(report.expectations);
}

/// An experiment that cannot be run, such as for a damaged scene, fails. It ends neither the others nor an earlier result.
Verdict run_or_fail(const Experiment& experiment, const ReproduceOptions& options,
                    const lab::RunSettings& settings, const lab::ReportFolder& folder, Steps& steps) {
    try {
        return run(experiment, options, settings, folder, steps);
    } catch (const std::runtime_error& error) {
        steps.finish();
        print_message("nusselt-lab: error: {}: {}\n", experiment.name, error.what());
        return Verdict::fails;
    }
}

/// The experiments with expectations that fail or were not evaluated, which may be far above.
void print_verdicts(const std::vector<Experiment>& experiments, const std::vector<Verdict>& verdicts) {
    const auto print_those = [&](Verdict verdict, std::string_view heading) {
        std::string names;
        for (std::size_t i = 0; i < verdicts.size(); ++i)
            if (verdicts[i] == verdict) names += " " + experiments[i].name;
        if (!names.empty()) fmt::print("\n{}:{}", heading, names);
    };
    print_those(Verdict::fails, "fails");
    print_those(Verdict::not_evaluated, "not evaluated, wholly or in part");
}

} // namespace

void setup_reproduce(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<ReproduceOptions>();
    CLI::App* command = app.add_subcommand(
        "reproduce",
        "Measure the figures, tables and statements of the papers and check what they claim. Prints tables "
        "and writes a page with all numbers and images, index.html. Later runs into the same folder add to "
        "the page, and measure only what has changed. Without names, experiments that need another program "
        "are left out where it is missing. Exits with 1 if an expectation fails, with 3 if one could not be "
        "evaluated.");
    std::vector<std::string> names;
    for (const Experiment& e : lab::all_experiments()) names.push_back(e.name);
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
    CLI::Option* const full = command->add_flag_callback(
        "--full", [options] { options->effort = Effort::full; },
        "Image sizes and sample counts as each experiment defines them; takes hours");
    command
        ->add_flag_callback(
            "--quick", [options] { options->effort = Effort::quick; },
            "Small images and few samples; takes minutes (the default)")
        ->excludes(full);
    command->add_option("--scenes", options->scenes, "Folder with the shipped scenes")->type_name("FOLDER");
    command->add_option("-o,--out", options->output, "Folder for the page, created if missing")
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
    static_cast<void>(base::choose_isa()); // reports a wrong one before anything is measured
    const std::vector<Experiment> experiments = chosen(options.experiments);
    const lab::ReportFolder folder(options.output);
    for (const Experiment& e : experiments)
        if (e.obstacle().empty()) folder.check_writable(e, options.effort);
    const lab::RunSettings settings = {options.scenes, options.effort,
                                       render_cpu::checked_thread_count(options.threads)};
    std::vector<Verdict> verdicts;
    std::filesystem::path page;
    Steps steps(experiments.size());
    for (const Experiment& e : experiments) {
        steps.begin(e);
        verdicts.push_back(run_or_fail(e, options, settings, folder, steps));
        // After each one, so that there is a page to look at while the others run.
        page = folder.write_page(lab::all_experiments());
    }
    print_verdicts(experiments, verdicts);
    fmt::print("\n{}\n", page.string());
    const auto any = [&](Verdict verdict) {
        return std::find(verdicts.begin(), verdicts.end(), verdict) != verdicts.end();
    };
    if (any(Verdict::fails)) return 1;
    return any(Verdict::not_evaluated) ? kNotEvaluated : 0;
}

} // namespace nusselt::app
