#include "submit.h"

#include "render.h"
#include "render_settings.h"

#include "apps/common/help.h"
#include "apps/common/jobs/inputs.h"
#include "apps/common/jobs/refused_options.h"
#include "apps/common/validators.h"
#include "apps/nusselt/scene/camera.h"
#include "apps/nusselt/scene/lights.h"
#include "base/file_checks.h"
#include "base/isa.h"
#include "image/io.h"
#include "render/settings.h"
#include "scene/model/fingerprint.h"
#include "scene/rig/camera_file.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <utility>
#include <vector>

namespace nusselt::app {

namespace {

/// Reads the options as `nusselt render` does, so that mistakes are found before thousands of tasks make them.
/// \throws CLI::ParseError
RenderOptions read_render_options(const SubmitRenderOptions& options) {
    refuse_options(options.render_options, {{"--part", "use the option --parts of submit"}});
    RenderOptions render;
    CLI::App parser("render");
    parser.set_help_flag(); // -h is an option of submit
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
    // The interval needs the checkpoint that parts have.
    render.part = fmt::format("1/{}", options.parts.value());
    render.checkpoint = "checkpoint";
    render.outputs = {options.output};
    check_combination(render);
    return render;
}

/// What the hash of all that an image depends on is, as in its metadata.
std::string fingerprint_of(const RenderOptions& options) {
    scene::Scene scene = load_scene(options.scene, options.rigs);
    if (options.camera) apply_camera(scene::read_camera_file(*options.camera), scene);
    return scene::fingerprint(scene);
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
    add_program_input(job);
    job.inputs["the scene " + options.scene.string()] = fingerprint_of(render);
    const std::string program = program_path().string();
    const std::string scene = std::filesystem::absolute(options.scene).string();
    std::vector<std::filesystem::path> inputs;
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
        inputs.push_back(output);
    }
    job.gather = {{{program, "merge", "-o", job.outputs.front().string()}, std::move(inputs)}};
    return submit_job(std::move(job), options.job);
}

void setup_submit(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<SubmitRenderOptions>();
    CLI::App* command = app.add_subcommand(
        "submit",
        "Divide a rendering into parts for many machines, and merge them. The image has the bits of a single "
        "run. The job is a folder with all that the engine needs: tasks that fail, are killed or lose their "
        "machine go on where their checkpoint ends, and the same command again does only what is missing.\n"
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
