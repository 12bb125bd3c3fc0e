#include "job.h"

#include "engine.h"
#include "script_text.h"

#include "base/atomic_file.h"
#include "base/words.h"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace nusselt::app {

namespace {

constexpr int kManifestVersion = 1;

// Exit codes that announce the end of the machine's time (130 and its like, see docs/rendering.md) go to the engine,
// which starts the task again where the checkpoint ends. Other failures, SIGKILL of the command among them, may pass:
// a full disk, memory that another task took, a folder that is slow to appear.
constexpr const char* kTask = R"sh(#!/bin/sh
# Usage: task.sh NUMBER
# Does a task of the job. A task that is done stays done; delete its file in results to do it again.
folder=$(cd "$(dirname "$0")" && pwd) || exit 1
number=$1
output=$(sed -n "${number}p" "$folder/outputs.txt")
if [ -e "$folder/done/$number" ] && [ -s "$output" ]; then exit 0; fi
cd @working_folder@ || exit 1
for attempt in 1 2 3; do
    code=0
    sh -c "exec $(sed -n "${number}p" "$folder/tasks.txt")" </dev/null >>"$folder/logs/$number.txt" 2>&1 || code=$?
    case $code in
        0)
            : >"$folder/done/$number" && exit 0
            code=1
            ;;
        2 | 129 | 130 | 138 | 143 | 152) break ;;
    esac
    echo "attempt $attempt of task $number ended with code $code on $(uname -n)" >>"$folder/logs/$number.txt"
    [ $attempt -eq 3 ] || sleep $attempt
done
exit $code
)sh";

// The file with the result appears at once when it is complete: who waits for it never reads half of it.
constexpr const char* kGather = R"sh(#!/bin/sh
# After all tasks, however they ended: gathers their results. If some are missing because their machine was lost or
# they were killed, it starts the job again, up to twice: only they are left to do. result.txt then has the exit code
# and a message.
cd @folder@ || exit 1
report() {
    echo "$1" >result.part
    echo "$2" | tr '\n' ' ' >>result.part
    mv result.part result.txt
    exit "$1"
}
missing= count=0
for number in $(seq @tasks@); do
    output=$(sed -n "${number}p" outputs.txt)
    if [ -e "done/$number" ] && [ -s "$output" ]; then continue; fi
    count=$((count + 1))
    [ $count -gt 8 ] || missing="$missing $number"
    first=${first:-$number}
done
if [ $count -gt 0 ]; then
    rounds=$(cat rounds.txt 2>/dev/null || echo 0)
    if [ "$rounds" -lt 2 ] && [ -x start.sh ]; then
        echo $((rounds + 1)) >rounds.txt
        echo "no result of $count tasks:$missing; starting them again" >>logs/gather.txt
        exec ./start.sh
    fi
    [ $count -le 8 ] || missing="$missing ..."
    reason=$(grep 'error: ' "logs/$first.txt" 2>/dev/null | tail -n 1)
    report 1 "$count of @tasks@ tasks left no result:$missing${reason:+ (the first one: $reason)}; see $PWD/logs, \
then run the same command again, which does only these"
fi
cd @working_folder@ || exit 1
while IFS= read -r command; do
    sh -c "$command" </dev/null >@folder@/logs/gather-command.txt 2>&1
    code=$?
    cat @folder@/logs/gather-command.txt >>@folder@/logs/gather.txt
    if [ $code -ne 0 ]; then
        cd @folder@ && report $code "$(cat logs/gather-command.txt)"
    fi
done <@folder@/gather.txt
cd @folder@ && report 0 "all @tasks@ tasks are done"
)sh";

std::string command_line(const Words& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + base::shell_word(word);
    return line;
}

std::vector<std::string> texts_of(const std::vector<std::filesystem::path>& paths) {
    std::vector<std::string> texts;
    for (const std::filesystem::path& path : paths) texts.push_back(path.string());
    return texts;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    base::write_atomically(path, [&](std::ofstream& stream) { stream << text; });
    if (path.extension() == ".sh")
        std::filesystem::permissions(path,
                                     std::filesystem::perms::owner_exec | std::filesystem::perms::group_exec,
                                     std::filesystem::perm_options::add);
}

/// Lists are read line by line.
void check_words(const Words& words) {
    for (const std::string& word : words)
        if (word.find('\n') != std::string::npos)
            throw std::runtime_error("'" + word +
                                     "' has a line break, which jobs do not support; rename the file");
}

/// Whether the folder has the same job already. \throws std::runtime_error if it has something else
bool has_job(const std::filesystem::path& folder, const std::string& manifest) {
    std::error_code ignored;
    if (!std::filesystem::exists(folder, ignored)) return false;
    std::ifstream stream(folder / "manifest.json", std::ios::binary);
    if (stream && std::string(std::istreambuf_iterator<char>(stream), {}) == manifest) return true;
    if (!stream && std::filesystem::is_directory(folder, ignored) &&
        std::filesystem::is_empty(folder, ignored))
        return false;
    throw std::runtime_error("'" + folder.string() + "' has " + (stream ? "another job" : "other files") +
                             "; delete it, or choose another folder with --job");
}

} // namespace

std::filesystem::path task_file(const std::filesystem::path& folder, const std::string& subfolder,
                                std::size_t number, const std::string& extension) {
    return folder / subfolder / (std::to_string(number) + extension);
}

std::filesystem::path program_path(const std::string& name) {
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
    const std::string wanted = name.empty() ? self.filename().string() : name;
    const std::filesystem::path folder = self.parent_path();
    std::vector<std::filesystem::path> candidates = {folder / wanted, folder.parent_path() / wanted / wanted};
    // In archives, bin/NAME brings the libraries for lib/programs/NAME.
    if (folder.filename() == "programs") candidates = {folder.parent_path().parent_path() / "bin" / wanted};
    for (const std::filesystem::path& path : candidates)
        if (std::filesystem::is_regular_file(path)) return path;
    throw std::runtime_error("the program " + wanted + " is missing beside '" + self.string() +
                             "'; build or install both");
}

nlohmann::ordered_json manifest_of(const Job& job, const Engine& engine) {
    nlohmann::ordered_json json = {{"version", kManifestVersion},
                                   {"kind", job.kind},
                                   {"name", job.name},
                                   {"engine", engine.name},
                                   {"folder", job.folder.string()},
                                   {"working_folder", job.working_folder.string()},
                                   {"threads", job.threads},
                                   {"tasks", nlohmann::ordered_json::array()},
                                   {"gather", job.gather},
                                   {"outputs", texts_of(job.outputs)}};
    for (std::size_t i = 0; i < job.tasks.size(); ++i)
        json["tasks"].push_back(
            {{"number", i + 1}, {"command", job.tasks[i].command}, {"output", job.tasks[i].output.string()}});
    return json;
}

void write_job(const Job& job, const Engine& engine) {
    const std::string manifest = manifest_of(job, engine).dump(2) + "\n";
    const bool goes_on = has_job(job.folder, manifest);
    std::error_code error;
    for (const char* name : {"results", "checkpoints", "logs", "done"}) {
        std::filesystem::create_directories(job.folder / name, error);
        if (error)
            throw std::runtime_error("cannot create the folder '" + (job.folder / name).string() +
                                     "': " + error.message() + "; choose another one with --job");
    }
    // Who asks again has removed the cause: lost tasks have all their rounds again.
    std::filesystem::remove(job.folder / "rounds.txt", error);
    if (goes_on) return;
    std::string tasks, outputs, gather;
    for (const JobTask& task : job.tasks) {
        check_words(task.command);
        tasks += command_line(task.command) + "\n";
        outputs += task.output.string() + "\n";
    }
    for (const Words& words : job.gather) {
        check_words(words);
        gather += command_line(words) + "\n";
    }
    write_text(job.folder / "tasks.txt", tasks);
    write_text(job.folder / "outputs.txt", outputs);
    write_text(job.folder / "gather.txt", gather);
    const std::string folder = base::shell_word(job.folder.string());
    const std::string working_folder = base::shell_word(job.working_folder.string());
    write_text(job.folder / "task.sh", filled(kTask, {{"working_folder", working_folder}}));
    // Slurm runs a copy of this script, so it has the folder's name.
    write_text(job.folder / "gather.sh", filled(kGather, {{"folder", folder},
                                                          {"working_folder", working_folder},
                                                          {"tasks", std::to_string(job.tasks.size())}}));
    for (const JobFile& file : engine.files(job)) write_text(job.folder / file.name, file.text);
    // Last: a folder with a manifest is complete.
    write_text(job.folder / "manifest.json", manifest);
}

} // namespace nusselt::app
