#include "submit.h"

#include "engine.h"
#include "follow.h"

#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "apps/common/progress.h"
#include "apps/common/validators.h"
#include "base/words.h"

#include <fmt/core.h>

#include <fstream>
#include <iterator>

namespace nusselt::app {

namespace {

int run_and_report(const Job& job, const SubmitOptions& options) {
    Progress progress(done_fraction(job));
    const int code = run_job(
        job,
        [&](double fraction) {
            if (!options.quiet) progress.update(fraction);
        },
        [&](const std::string& text) {
            progress.finish();
            if (!options.quiet) print_message("{}\n", text);
        });
    progress.finish();
    if (code == 0 && !options.quiet)
        for (const std::filesystem::path& output : job.outputs) fmt::print("{}\n", output.string());
    return code;
}

} // namespace

void add_submit_options(CLI::App& command, SubmitOptions& options) {
    command.add_option("--engine", options.engine, "What runs the tasks: " + engine_descriptions())
        ->required()
        ->transform(to_one_of(engine_names()))
        ->group(kJobGroup);
    command
        .add_option(
            "--job", options.folder,
            "Folder for the job, which all machines see. The same command again continues a job that it has")
        ->type_name("FOLDER")
        ->default_str("the name of the output with .job")
        ->group(kJobGroup);
    constexpr int kMaxThreads = 1024;
    command.add_option("--threads", options.threads, "Threads of each task")
        ->transform(to_whole_number(1, kMaxThreads))
        ->group(kJobGroup);
    command.add_flag("--run", options.runs, "Start the job, and follow it until its output is written")
        ->group(kJobGroup);
    command.add_flag("-q,--quiet", options.quiet, "Print only errors: no progress")->group(kOutputGroup);
}

std::filesystem::path job_folder(const SubmitOptions& options, const std::filesystem::path& output) {
    return std::filesystem::absolute(
               options.folder.value_or(std::filesystem::path(output).replace_extension(".job")))
        .lexically_normal();
}

int submit_job(Job job, const SubmitOptions& options) {
    const Engine& engine = engine_of(options.engine);
    const bool is_printed = !engine.printed_file.empty();
    if (options.runs && is_printed)
        throw CLI::ValidationError("--run", "nothing can be started with --engine " + options.engine);
    job.threads = options.threads;
    job.working_folder = std::filesystem::current_path();
    write_job(job, engine);
    if (options.runs) return run_and_report(job, options);
    if (is_printed) {
        std::ifstream stream(job.folder / engine.printed_file);
        fmt::print("{}", std::string(std::istreambuf_iterator<char>(stream), {}));
    } else {
        fmt::print("{}\n", job.folder.string());
        if (!options.quiet)
            print_message("start the job with {}, or with the same command and --run\n",
                          base::shell_word((job.folder / "start.sh").string()));
    }
    return 0;
}

} // namespace nusselt::app
