#include "submit.h"

#include "apps/common/help.h"
#include "apps/common/jobs/inputs.h"
#include "apps/common/jobs/refused_options.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "base/atomic_file.h"
#include "base/file_checks.h"
#include "base/isa.h"
#include "base/words.h"
#include "render/names.h"
#include "scene/import/importers.h"
#include "scene/model/fingerprint.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>
#include <system_error>

namespace nusselt::app {

namespace {

std::string isa_name() { return std::string(name_of(base::choose_isa())); }

Words joined(Words words, const Words& others) {
    words.insert(words.end(), others.begin(), others.end());
    return words;
}

/// Exit code 1 may mean an error, or a result that breaks a contract. The file with the result tells which, if it is
/// from this attempt. Other codes stay as they are: they say whether another attempt is of use.
Words with_result_as_success(const Words& command, const std::filesystem::path& output) {
    std::string line;
    for (const std::string& word : command) line += base::shell_word(word) + " ";
    const std::string file = base::shell_word(output.string());
    return {"sh", "-c",
            "rm -f " + file + "; " + line + "; code=$?; [ $code -eq 1 ] && [ -s " + file +
                " ] && exit 0; exit $code"};
}

Job make_job(const std::string& kind, const SubmitOptions& options, const std::filesystem::path& output) {
    Job job;
    job.kind = kind;
    job.name = "nusselt-" + kind;
    job.folder = job_folder(options, output);
    job.outputs = {std::filesystem::absolute(output).lexically_normal()};
    return job;
}

void add_shard(Job& job, const Words& command, const SubmitShardsOptions& options) {
    const std::filesystem::path output = task_file(job.folder, "results", job.tasks.size() + 1, ".json");
    const Words words =
        joined(command, {"--threads", std::to_string(options.job.threads), "--json", output.string()});
    job.tasks.push_back({with_result_as_success(words, output), output});
}

int submit_shards(Job job, const SubmitShardsOptions& options) {
    refuse_options(options.options, {{"--count", "use the option --count of submit"},
                                     {"--starts", "use the option --starts of submit"},
                                     {"--seed", "use the option --seed of submit"},
                                     {"--isa", "all tasks use the one of this machine"},
                                     {"--first", "submit divides the work itself"},
                                     {"--state", "each task has one"},
                                     {"--convergence", "shards have too few starts for it"}});
    base::check_writable(options.output);
    add_program_input(job);
    add_file_inputs(job, options.options);
    GatherStep gather{{program_path().string(), "gather", "-o", job.outputs.front().string()}, {}};
    for (const JobTask& task : job.tasks) gather.inputs.push_back(task.output);
    job.gather = {gather};
    return submit_job(std::move(job), options.job);
}

/// Scenes of one name would write the same files.
void check_names(const std::vector<std::filesystem::path>& scenes) {
    std::set<std::string> names;
    for (const std::filesystem::path& scene : scenes)
        if (!names.insert(scene.stem().string()).second)
            throw std::runtime_error(
                fmt::format("two scenes have the name '{}'; submit them one by one", scene.stem().string()));
}

/// Each technique once, or two merges would write one file.
void check_techniques(const std::vector<std::string>& techniques) {
    std::set<std::string> names;
    for (const std::string& technique : techniques)
        if (!names.insert(technique).second)
            throw CLI::ValidationError("--technique", fmt::format("'{}' is there twice", technique));
}

void add_output_option(CLI::App& command, std::filesystem::path& output, const std::string& description,
                       const std::string& type) {
    command.add_option("-o,--output", output, description)->type_name(type)->required()->group(kOutputGroup);
}

void add_shards_command(CLI::App& submit, const std::string& name, const std::string& description,
                        const std::string& count_name, const std::string& of_what, std::uint64_t count,
                        int (*run)(const SubmitShardsOptions&), int& exit_code) {
    const auto options = std::make_shared<SubmitShardsOptions>();
    options->count = count;
    CLI::App* command = submit.add_subcommand(name, description);
    command->add_option("OPTIONS", options->options, "Other options of the command, behind --");
    add_output_option(*command, options->output, "JSON file to write, with a column for the shard", "FILE");
    constexpr std::uint64_t kMost = 1'000'000'000'000;
    command->add_option(count_name, options->count, of_what + ", in all shards together")
        ->transform(to_whole_number(1, kMost))
        ->group(kJobGroup);
    command->add_option("--seed", options->seed, "Seed of the first shard")
        ->transform(to_whole_number(0, kMost))
        ->group(kJobGroup);
    constexpr int kMostShards = 1'000'000;
    command->add_option("--shards", options->shards, "Shards, each of which is a task")
        ->transform(to_whole_number(1, kMostShards))
        ->group(kJobGroup);
    add_submit_options(*command, options->job);
    command->callback([options, run, &exit_code] { exit_code = run(*options); });
}

} // namespace

int run_submit_images(const SubmitImagesOptions& options) {
    base::check_exist(options.scenes);
    check_names(options.scenes);
    check_techniques(options.techniques);
    refuse_options(options.render_options, {{"--technique", "use the option --technique of submit"},
                                            {"--seed", "use the option --seeds of submit"},
                                            {"--isa", "all tasks use the one of this machine"}});
    Job job = make_job("images", options.job, options.output);
    job.outputs.clear();
    const std::filesystem::path folder = std::filesystem::absolute(options.output).lexically_normal();
    const std::string program = program_path("nusselt").string();
    add_program_input(job, "nusselt");
    add_file_inputs(job, options.render_options);
    for (const std::filesystem::path& scene : options.scenes) {
        job.inputs["the scene " + scene.string()] = scene::fingerprint(scene::load_scene(scene));
        for (const std::string& technique : options.techniques) {
            const std::filesystem::path image =
                folder / fmt::format("{}-{}.exr", scene.stem().string(), technique);
            GatherStep merge{{program, "merge", "-o", image.string()}, {}};
            for (int seed = 0; seed < options.seeds; ++seed) {
                const std::size_t number = job.tasks.size() + 1;
                const std::filesystem::path output = task_file(job.folder, "results", number, ".exr");
                const Words command =
                    joined(joined({program, "render", std::filesystem::absolute(scene).string()},
                                  options.render_options),
                           {"--technique", technique, "--seed", std::to_string(seed), "--isa", isa_name(),
                            "--threads", std::to_string(options.job.threads), "--checkpoint",
                            task_file(job.folder, "checkpoints", number, "").string(), "--quiet", "-o",
                            output.string()});
                job.tasks.push_back({command, output});
                merge.inputs.push_back(output);
            }
            job.gather.push_back(merge);
            job.outputs.push_back(image);
        }
    }
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error(
            fmt::format("cannot create the folder '{}': {}; choose another one with --output",
                        folder.string(), error.message()));
    return submit_job(std::move(job), options.job);
}

int run_submit_fuzz(const SubmitShardsOptions& options) {
    Job job = make_job("fuzz", options.job, options.output);
    // Configurations depend on their index only, so that shards are consecutive pieces of one run.
    const auto shards = static_cast<std::uint64_t>(options.shards);
    const std::uint64_t each = (options.count + shards - 1) / shards;
    for (std::uint64_t first = 0; first < options.count; first += each)
        add_shard(job,
                  joined(joined({program_path().string(), "fuzz"}, options.options),
                         {"--first", std::to_string(first), "--count",
                          std::to_string(std::min(each, options.count - first)), "--seed",
                          std::to_string(options.seed), "--isa", isa_name()}),
                  options);
    return submit_shards(std::move(job), options);
}

int run_submit_worst_case(const SubmitShardsOptions& options) {
    Job job = make_job("worst-case", options.job, options.output);
    const auto shards = static_cast<std::uint64_t>(options.shards);
    const std::uint64_t each = (options.count + shards - 1) / shards;
    for (std::uint64_t shard = 0; shard < shards; ++shard)
        add_shard(job,
                  joined(joined({program_path().string(), "bench", "worst-case"}, options.options),
                         {"--starts", std::to_string(each), "--seed", std::to_string(options.seed + shard),
                          "--state", task_file(job.folder, "checkpoints", shard + 1, "").string(),
                          "--convergence", "0"}),
                  options);
    return submit_shards(std::move(job), options);
}

void setup_submit(CLI::App& app, int& exit_code) {
    CLI::App* submit = app.add_subcommand(
        "submit",
        "Divide sweeps among many machines, by the engines and with the job folders of `nusselt submit`.");
    submit->require_subcommand(1);

    const auto images = std::make_shared<SubmitImagesOptions>();
    CLI::App* command =
        submit->add_subcommand("images", "Render each scene with each technique and each seed, and merge the "
                                         "seeds of each to SCENE-TECHNIQUE.exr.");
    // Words behind -- are options of the renderer, so that scenes have a name.
    command->add_option("OPTIONS", images->render_options, "Options of `nusselt render`, behind --");
    command->add_option("--scene", images->scenes, "Scene file. May be repeated")
        ->type_name("FILE")
        ->required()
        ->allow_extra_args(false)
        ->group(kJobGroup);
    command->add_option("--technique", images->techniques, "Technique of samples. May be repeated")
        ->required()
        ->allow_extra_args(false)
        ->transform(to_one_of(names_of(render::kTechniques)))
        ->group(kJobGroup);
    constexpr int kMostSeeds = 100'000;
    command->add_option("--seeds", images->seeds, "Seeds of each, from 0 on")
        ->transform(to_whole_number(1, kMostSeeds))
        ->group(kJobGroup);
    add_output_option(*command, images->output, "Folder for the images", "FOLDER");
    add_submit_options(*command, images->job);
    command->callback([images, &exit_code] { exit_code = run_submit_images(*images); });

    add_shards_command(*submit, "fuzz",
                       "Run `nusselt-lab fuzz` in shards, which are consecutive pieces of one run.",
                       "--count", "Configurations per technique", 10'000'000, run_submit_fuzz, exit_code);
    add_shards_command(*submit, "worst-case",
                       "Run `nusselt-lab bench worst-case` in shards with different seeds.", "--starts",
                       "Starts per target", 100'000, run_submit_worst_case, exit_code);
}

} // namespace nusselt::app
