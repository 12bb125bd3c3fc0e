#pragma once
/// Work that is divided into tasks, which many machines do, and a last step that gathers their results.
///
/// A job is a folder that all machines see. It has all that an engine needs to do the work, and what the work leaves:
///
///     manifest.json   the job in full, for programs; the only file that says what the job is
///     tasks.txt       the command of each task, one per line
///     outputs.txt     the file that each task writes
///     task.sh         does one task: nothing if it is done, otherwise up to three attempts
///     missing.sh      prints which tasks are not done
///     gather.txt      the commands that gather results; inputs has the lists of files that they read
///     gather.sh       after the tasks: gathers results, or starts again what was lost, or says what is missing
///     start.sh        hands the job to the engine; alive.sh asks the engine about it
///     results, checkpoints, logs, done
///
/// Tasks that are done stay done, whoever starts the job again, so any step may be repeated at any time.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nusselt::app {

using Words = std::vector<std::string>;

struct JobTask {
    Words command;                ///< exit code 0 for success, 2 if another attempt is of no use
    std::filesystem::path output; ///< absolute
};

/// A command that gathers results.
struct GatherStep {
    Words command;
    /// Files of results. The command gets them as `--list FILE`, with one path per line: there may be more of them than a
    /// command line can have.
    std::vector<std::filesystem::path> inputs;
};

struct Job {
    std::string kind; ///< what it computes, such as "image"
    std::string name; ///< for the engine's lists, without spaces
    std::filesystem::path folder;
    std::filesystem::path working_folder; ///< of all commands
    int threads = 1;                      ///< of each task
    /// What the results depend on beside the commands, such as {"the scene a.pbrt", hash}. A folder with results of
    /// other inputs is not continued.
    std::map<std::string, std::string> inputs;
    std::vector<JobTask> tasks;                 ///< numbered from 1
    std::vector<GatherStep> gather;             ///< in this order
    std::vector<std::filesystem::path> outputs; ///< of `gather`
};

struct Engine;

/// The file of a task in a job's folder, such as results/7.exr.
std::filesystem::path task_file(const std::filesystem::path& folder, const std::string& subfolder,
                                std::size_t number, const std::string& extension);

/// The path by which this program, or another one beside it, is started on another machine.
/// \param name of the program; empty for this one
std::filesystem::path program_path(const std::string& name = "");

nlohmann::ordered_json manifest_of(const Job& job, const Engine& engine);

/// Writes the folder. If it has the same job already, what is done stays.
/// \throws std::runtime_error if the folder has another job or something else, or cannot be written; if the inputs have
///                            changed since the job was written; or if a path or option has a line break
void write_job(const Job& job, const Engine& engine);

} // namespace nusselt::app
