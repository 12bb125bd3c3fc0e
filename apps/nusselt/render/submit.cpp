#include "submit.h"

#include "render.h"
#include "render_settings.h"

#include "apps/common/help.h"
#include "apps/common/validators.h"
#include "base/file_checks.h"
#include "base/isa.h"
#include "image/io.h"
#include "render/settings.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <memory>

namespace nusselt::app {

namespace {

/// What a job decides itself.
void refuse_options_of_jobs(const RenderOptions& options) {
    const auto refuse = [](const char* name, const char* instead) {
        throw CLI::ValidationError(name, std::string("not supported behind --: ") + instead);
    };
    if (!options.outputs.empty()) refuse("--output", "use the option -o of submit");
    if (options.part) refuse("--part", "use the option --parts of submit");
    if (options.checkpoint) refuse("--checkpoint", "each part has one");
    if (options.threads) refuse("--threads", "use the option --threads of submit");
    if (options.json) refuse("--json", "each part would write the same file");
    if (options.display_server) refuse("--display-server", "parts run on other machines");
    if (options.backend != "cpu") refuse("--backend", "parts are rendered on the CPU");
}

/// Reads the options as `nusselt render` does, so that mistakes are found before thousands of tasks make them.
/// \throws CLI::ParseError
RenderOptions read_render_options(const SubmitRenderOptions& options) {
    RenderOptions render;
    CLI::App parser("render");
    parser.option_defaults()->always_capture_default();
    add_render_options(parser, render);
    std::vector<std::string> words = options.render_options;
    words.insert(words.begin(), options.scene.string());
    std::reverse(words.begin(), words.end()); // as CLI11 wants them
    try {
        parser.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        const std::vector<std::string> extras = parser.remaining();
        throw CLI::ValidationError("the options behind --", extras.empty()
                                                                ? std::string(error.what())
                                                                : "unknown '" + extras.front() + "'");
    }
    refuse_options_of_jobs(render);
    // The interval needs the checkpoint that parts have.
    render.part = fmt::format("1/{}", options.parts.value());
    render.checkpoint = "checkpoint";
    render.outputs = {options.output};
    check_combination(render);
    return render;
}

} // namespace

int run_submit(const SubmitRenderOptions& options) {
    const RenderOptions render = read_render_options(options);
    base::check_exist({options.scene});
    image::check_writable_image(options.output);
    Job job;
    job.kind = "image";
    job.name = "nusselt-" + options.output.stem().string();
    std::replace_if(
        job.name.begin(), job.name.end(), [](unsigned char c) { return std::isspace(c) != 0; }, '_');
    job.folder = job_folder(options.job, options.output);
    job.outputs = {std::filesystem::absolute(options.output)};
    const std::string program = program_path().string();
    const std::string scene = std::filesystem::absolute(options.scene).string();
    Words merge = {program, "merge", "-o", job.outputs.front().string()};
    const int parts = options.parts.value();
    for (int part = 1; part <= parts; ++part) {
        const auto number = static_cast<std::size_t>(part);
        const std::filesystem::path output = task_file(job.folder, "results", number, ".exr");
        Words command = {program, "render", scene};
        command.insert(command.end(), options.render_options.begin(), options.render_options.end());
        // All machines use one instruction set, whatever they have: otherwise parts would differ in their last bits.
        if (!render.isa) command.insert(command.end(), {"--isa", std::string(name_of(base::choose_isa()))});
        if (parts > 1) command.insert(command.end(), {"--part", fmt::format("{}/{}", part, parts)});
        command.insert(command.end(), {"--threads", std::to_string(options.job.threads), "--checkpoint",
                                       task_file(job.folder, "checkpoints", number, "").string(), "--quiet",
                                       "-o", output.string()});
        job.tasks.push_back({std::move(command), output});
        merge.push_back(output.string());
    }
    job.gather = {merge};
    return submit_job(std::move(job), options.job);
}

void setup_submit(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<SubmitRenderOptions>();
    CLI::App* command = app.add_subcommand(
        "submit", "Divide a rendering into parts for many machines, and merge them. The image has the bits "
                  "of a single run. The job is "
                  "a folder with all that the engine needs: tasks that fail, are killed or lose their "
                  "machine go on where their "
                  "checkpoint ends, and the same command again does only what is missing.\n"
                  "  nusselt submit scene.pbrt --parts 8 --engine slurm --run -o image.exr -- --spp 64");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    command->add_option("OPTIONS", options->render_options, "Options of `nusselt render`, behind --");
    command->add_option("-o,--output", options->output, "EXR file to write")
        ->type_name("FILE")
        ->required()
        ->check([](const std::filesystem::path& path) {
            return image::is_exr(path) ? std::string()
                                       : "'" + path.string() + "' must be the name of an EXR file";
        })
        ->group(kOutputGroup);
    command->add_option("--parts", options->parts, "Parts, each of which is a task")
        ->required()
        ->transform(to_whole_number(1, render::kMaxParts))
        ->group(kJobGroup);
    add_submit_options(*command, options->job);
    command->callback([options, &exit_code] { exit_code = run_submit(*options); });
}

} // namespace nusselt::app
