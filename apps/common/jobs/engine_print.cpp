#include "engine.h"

#include <stdexcept>

namespace nusselt::app {

namespace {

/// A step that runs a script of the folder. Lists of arguments may not be empty.
nlohmann::ordered_json step(const Job& job, const std::string& name, const std::string& script,
                            const Words& arguments) {
    nlohmann::ordered_json run = {{"command", (job.folder / script).string()}};
    if (!arguments.empty()) run["args"] = arguments;
    return {{"name", name}, {"script", {{"actions", {{"onRun", run}}}}}};
}

/// At most so many bytes of a text, which end between two characters.
std::string beginning_of(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
    return text.substr(0, most);
}

/// A job template of the Open Job Description 2023-09, which AWS Deadline Cloud and others read.
/// \throws std::runtime_error if the template would mean something else
std::vector<JobFile> files(const Job& job) {
    if (job.folder.string().find("{{") != std::string::npos)
        throw std::runtime_error("'" + job.folder.string() +
                                 "' has {{, which job templates expand; choose another folder with --job");
    constexpr std::size_t kMostNameBytes = 128;
    nlohmann::ordered_json tasks = step(job, "Tasks", "task.sh", {"{{Task.Param.Task}}"});
    tasks["parameterSpace"] = {
        {"taskParameterDefinitions",
         {{{"name", "Task"}, {"type", "INT"}, {"range", "1-" + std::to_string(job.tasks.size())}}}}};
    // In place of SIGKILL, so that checkpoints are written.
    tasks["script"]["actions"]["onRun"]["cancelation"] = {{"mode", "NOTIFY_THEN_TERMINATE"}};
    tasks["hostRequirements"] = {{"amounts", {{{"name", "amount.worker.vcpu"}, {"min", job.threads}}}}};
    nlohmann::ordered_json gather = step(job, "Gather", "gather.sh", {});
    // Here, a task that fails for good stops the job, and the engine shows that; there is no step after failed ones.
    gather["dependencies"] = {{{"dependsOn", "Tasks"}}};
    const nlohmann::ordered_json job_template = {{"specificationVersion", "jobtemplate-2023-09"},
                                                 {"name", beginning_of(job.name, kMostNameBytes)},
                                                 {"steps", {tasks, gather}}};
    return {{"template.json", job_template.dump(2) + "\n"}};
}

} // namespace

extern const Engine kOpenJobDescription;
const Engine kOpenJobDescription = {"print",
                                    "which prints a job template for engines that read Open Job Description",
                                    files, "template.json"};

} // namespace nusselt::app
