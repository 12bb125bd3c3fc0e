#include "job.h"

#include "engine.h"
#include "job_scripts.h"
#include "script_text.h"

#include "base/atomic_file.h"
#include "base/words.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace nusselt::app {

namespace {

constexpr int kManifestVersion = 1;

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

bool is_utf8(const std::string& text) {
    try {
        static_cast<void>(nlohmann::ordered_json(text).dump());
        return true;
    } catch (const nlohmann::ordered_json::type_error&) {
        return false;
    }
}

/// Lists are read line by line, and manifests are in UTF-8.
void check_words(const Words& words) {
    for (const std::string& word : words) {
        const bool has_break = word.find('\n') != std::string::npos;
        if (!has_break && is_utf8(word)) continue;
        throw std::runtime_error("'" + word + "' has " +
                                 (has_break ? "a line break" : "characters that are no UTF-8") +
                                 ", which jobs do not support; rename the file");
    }
}

void check_all_words(const Job& job) {
    check_words({job.folder.string(), job.working_folder.string()});
    for (const JobTask& task : job.tasks) {
        check_words(task.command);
        check_words({task.output.string()});
    }
    for (const GatherStep& step : job.gather) check_words(step.command);
    check_words(texts_of(job.outputs));
}

constexpr std::array<const char*, 5> kFolders = {"results", "checkpoints", "logs", "done", "inputs"};

/// Whether a folder has nothing but what write_job() leaves if it is stopped: no results, and no other files.
bool is_half_written(const std::filesystem::path& folder) {
    static const std::set<std::string> kFiles = {
        "tasks.txt", "outputs.txt", "gather.txt",     "task.sh", "missing.sh", "gather.sh",    "start.sh",
        "alive.sh",  "array.sh",    "gather-step.sh", "inputs",  "logs",       "template.json"};
    std::error_code ignored, error;
    if (!std::filesystem::is_directory(folder, ignored)) return false;
    const std::filesystem::directory_iterator entries(folder, error);
    if (error)
        throw std::runtime_error("cannot read the folder '" + folder.string() + "': " + error.message() +
                                 "; choose another one with --job");
    for (const auto& entry : entries) {
        const std::string name = entry.path().filename().string();
        const bool is_empty_folder = entry.is_directory() && std::filesystem::is_empty(entry.path(), ignored);
        const bool is_ours = kFiles.count(name) != 0 || name.starts_with(".nusselt-") ||
                             std::find(kFolders.begin(), kFolders.end(), name) != kFolders.end();
        if (!is_ours || (entry.is_directory() && !is_empty_folder && name != "inputs")) return false;
    }
    return true;
}

/// The inputs that differ, if all else is the same.
std::vector<std::string> changed_inputs(const std::string& text, const nlohmann::ordered_json& manifest) {
    nlohmann::ordered_json other = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!other.is_object() || !other.contains("inputs") || !other["inputs"].is_object()) return {};
    const nlohmann::ordered_json inputs = std::exchange(other["inputs"], manifest.at("inputs"));
    std::vector<std::string> changed;
    if (other != manifest) return changed;
    for (const auto& [name, hash] : manifest.at("inputs").items())
        if (!inputs.contains(name) || inputs[name] != hash) changed.push_back(name);
    return changed;
}

/// Where two commands part, such as "--spp 4 in place of --spp 8"; empty if they do not.
std::string difference(const Words& before, const Words& now) {
    const auto [a, b] = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
    if (a == before.end() && b == now.end()) return "";
    // The value of an option says little without it.
    const auto index = a - before.begin();
    const std::string option = index > 0 && before[static_cast<std::size_t>(index - 1)].starts_with("--")
                                   ? before[static_cast<std::size_t>(index - 1)] + " "
                                   : "";
    const auto text = [&](const Words& words, Words::const_iterator word) {
        return word == words.end() ? std::string("nothing") : "'" + option + *word + "'";
    };
    return text(before, a) + " in place of " + text(now, b);
}

/// What another job has in place of this one's, as far as its manifest says so: the first of all differences.
std::string difference(const std::string& text, const nlohmann::ordered_json& manifest) {
    const nlohmann::ordered_json other = nlohmann::ordered_json::parse(text, nullptr, false);
    try {
        const auto& tasks = other.at("tasks");
        const auto& now = manifest.at("tasks");
        if (tasks.size() != now.size())
            return std::to_string(tasks.size()) + " tasks in place of " + std::to_string(now.size());
        for (std::size_t i = 0; i < now.size(); ++i) {
            const std::string found =
                difference(tasks.at(i).at("command").get<Words>(), now.at(i).at("command").get<Words>());
            if (!found.empty()) return found;
        }
        for (const char* key : {"engine", "working_folder"})
            if (other.at(key) != manifest.at(key))
                return "'" + other.at(key).get<std::string>() + "' in place of '" +
                       manifest.at(key).get<std::string>() + "'";
    } catch (const nlohmann::ordered_json::exception&) {
        // Not written by us, or by another version.
    }
    return "";
}

/// Whether the folder has the same job already. \throws std::runtime_error if it has something else
bool has_job(const std::filesystem::path& folder, const nlohmann::ordered_json& manifest) {
    std::error_code ignored;
    if (!std::filesystem::exists(folder, ignored)) return false;
    std::ifstream stream(folder / "manifest.json", std::ios::binary);
    if (!stream && is_half_written(folder)) return false;
    const std::string text = stream ? std::string(std::istreambuf_iterator<char>(stream), {}) : "";
    if (stream && text == manifest.dump(2) + "\n") return true;
    const std::string remedy = "; delete it, or choose another folder with --job";
    if (const std::vector<std::string> changed = changed_inputs(text, manifest); !changed.empty())
        throw std::runtime_error("since the job in '" + folder.string() + "' was written, " +
                                 base::listing(changed, "and") + (changed.size() == 1 ? " has" : " have") +
                                 " changed" + remedy);
    if (!stream) throw std::runtime_error("'" + folder.string() + "' has other files" + remedy);
    const std::string found = difference(text, manifest);
    throw std::runtime_error("'" + folder.string() + "' has another job" +
                             (found.empty() ? "" : " (" + found + ")") + remedy);
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
                                   {"inputs", job.inputs},
                                   {"tasks", nlohmann::ordered_json::array()},
                                   {"gather", nlohmann::ordered_json::array()},
                                   {"outputs", texts_of(job.outputs)}};
    for (std::size_t i = 0; i < job.tasks.size(); ++i)
        json["tasks"].push_back(
            {{"number", i + 1}, {"command", job.tasks[i].command}, {"output", job.tasks[i].output.string()}});
    for (const GatherStep& step : job.gather)
        json["gather"].push_back({{"command", step.command}, {"inputs", texts_of(step.inputs)}});
    return json;
}

void write_job(const Job& job, const Engine& engine) {
    check_all_words(job);
    const nlohmann::ordered_json manifest = manifest_of(job, engine);
    const std::vector<JobFile> engine_files = engine.files(job);
    const bool goes_on = has_job(job.folder, manifest);
    std::error_code error;
    for (const char* name : kFolders) {
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
        tasks += command_line(task.command) + "\n";
        outputs += task.output.string() + "\n";
    }
    for (std::size_t i = 0; i < job.gather.size(); ++i) {
        const std::filesystem::path list = task_file(job.folder, "inputs", i + 1, ".txt");
        std::string inputs;
        for (const std::filesystem::path& path : job.gather[i].inputs) inputs += path.string() + "\n";
        write_text(list, inputs);
        gather += command_line(job.gather[i].command) + " --list " + base::shell_word(list.string()) + "\n";
    }
    write_text(job.folder / "tasks.txt", tasks);
    write_text(job.folder / "outputs.txt", outputs);
    write_text(job.folder / "gather.txt", gather);
    const std::string folder = base::shell_word(job.folder.string());
    const std::string working_folder = base::shell_word(job.working_folder.string());
    write_text(job.folder / "task.sh", filled(kTaskScript, {{"working_folder", working_folder}}));
    write_text(job.folder / "missing.sh", kMissingScript);
    write_text(job.folder / "gather.sh",
               filled(kGatherScript, {{"folder", folder},
                                      {"working_folder", working_folder},
                                      {"tasks", std::to_string(job.tasks.size())}}));
    for (const JobFile& file : engine_files) write_text(job.folder / file.name, file.text);
    // Last: a folder with a manifest is complete.
    write_text(job.folder / "manifest.json", manifest.dump(2) + "\n");
}

} // namespace nusselt::app
