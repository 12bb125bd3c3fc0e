#include "lab/report/report_folder.h"

#include "base/atomic_file.h"
#include "base/isa.h"
#include "base/machine.h"
#include "image/io.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStateFile = "state.json";
constexpr const char* kSectionFile = "section.json";
constexpr const char* kNumbersFile = "numbers.json";

/// Tells contents apart that differ by chance, not by malice (FNV-1a). Empty for files that cannot be read.
std::string fingerprint(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return "";
    std::uint64_t hash = 0xcbf29ce484222325u;
    std::array<char, 1 << 16> block;
    while (file) {
        file.read(block.data(), block.size());
        for (std::streamsize i = 0; i < file.gcount(); ++i)
            hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 0x100000001b3u;
    }
    return fmt::format("{:016x}", hash);
}

/// Everything but the effort and files on which an experiment depends.
std::string key_of(const std::string& program, const RunSettings& settings) {
    const Json key = {program,
                      base::name_of(base::choose_isa()),
                      base::processor_name(),
                      thread_count(settings),
                      std::filesystem::absolute(settings.scenes).string(),
                      published_scenes().value_or("").string()};
    return key.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error("cannot create the folder '" + folder.string() + "' (" + error.message() +
                                 "); choose another one with --out");
}

/// Whether each expectation holds, or null with a reason.
ResultTable expectation_table(const std::vector<ExpectationResult>& expectations) {
    ResultTable table = {"expectations", {{"expectation"}, {"holds"}, {"reason"}}};
    for (const ExpectationResult& e : expectations)
        table.rows.push_back(
            {e.text, e.verdict == Verdict::not_evaluated ? Cell(nullptr) : Cell(e.verdict == Verdict::holds),
             e.reason});
    return table;
}

/// Empty if the file cannot be read.
std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path)) return "";
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    base::write_atomically(path, [&](std::ofstream& file) { file << text; });
}

} // namespace

std::string file_stem(const std::string& label) {
    std::string stem;
    for (const char c : label) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_')
            stem += c;
        else if (!stem.empty() && stem.back() != '-')
            stem += '-';
    }
    return stem;
}

ReportFolder::ReportFolder(std::filesystem::path folder)
    : folder_(std::move(folder)), program_(fingerprint("/proc/self/exe")) {
    create_folder(folder_);
}

std::filesystem::path ReportFolder::folder_of(const Experiment& experiment, Effort effort) const {
    return folder_ / experiment.name / (effort == Effort::quick ? "quick" : "full");
}

void ReportFolder::check_writable(const Experiment& experiment, Effort effort) const {
    const std::filesystem::path folder = folder_of(experiment, effort);
    create_folder(folder);
    base::check_writable(folder / kNumbersFile);
    base::check_writable(folder_ / "index.html");
}

std::optional<KeptReport> ReportFolder::kept(const Experiment& experiment,
                                             const RunSettings& settings) const {
    if (program_.empty()) return std::nullopt;
    const std::string key = key_of(program_, settings);
    const auto full = kept_in(folder_of(experiment, Effort::full), key);
    return full || settings.effort == Effort::full ? full
                                                   : kept_in(folder_of(experiment, Effort::quick), key);
}

std::optional<KeptReport> ReportFolder::kept_in(const std::filesystem::path& folder,
                                                const std::string& key) const {
    std::ifstream file(folder / kStateFile);
    try {
        const Json state = Json::parse(file);
        if (state.at("key") != key) return std::nullopt;
        if (checked_section(contents(folder / kSectionFile)).empty()) return std::nullopt;
        for (const auto& [path, hash] : state.at("inputs").items())
            if (fingerprint(path) != hash) return std::nullopt;
        for (const auto& [name, hash] : state.at("outputs").items())
            if (fingerprint(folder / name) != hash) return std::nullopt;
        return KeptReport{state.at("date"), state.at("verdict").get<Verdict>()};
    } catch (const Json::exception&) {
        return std::nullopt; // nothing there, or damaged
    }
}

void ReportFolder::write(const Experiment& experiment, const Report& report, const RunSettings& settings,
                         const RunRecord& record) const {
    const std::filesystem::path folder = folder_of(experiment, settings.effort);
    std::filesystem::create_directories(folder);
    std::filesystem::remove(folder / kStateFile);
    for (const ReportImage& image : report.images) {
        const std::string stem = file_stem(image.label);
        image::write_image(folder / (stem + ".png"), image.image);
        if (image.role != ImageRole::picture) image::write_image(folder / (stem + ".exr"), image.image);
    }
    for (const Plot& plot : report.plots) write_text(folder / (plot.file + ".svg"), to_svg(plot));
    for (const Drawing& drawing : report.drawings) write_text(folder / (drawing.file + ".svg"), drawing.svg);
    Results numbers = report.numbers;
    numbers.tables.push_back(expectation_table(report.expectations));
    write_text(folder / kNumbersFile, to_json(numbers));
    write_text(folder / kSectionFile, page_section(experiment, report, settings.effort, record));
    Json inputs = Json::object();
    for (const std::filesystem::path& path : report.inputs)
        inputs[std::filesystem::absolute(path).string()] = fingerprint(path);
    Json outputs = Json::object();
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        outputs[entry.path().filename().string()] = fingerprint(entry.path());
    const Json state = {{"key", key_of(program_, settings)},
                        {"date", record.date},
                        {"verdict", verdict_of(report.expectations)},
                        {"inputs", std::move(inputs)},
                        {"outputs", std::move(outputs)}};
    // Last: an interrupted run leaves no state, and the experiment runs again.
    write_text(folder / kStateFile, state.dump(1, ' ', false, Json::error_handler_t::replace));
}

std::filesystem::path ReportFolder::write_page(const std::vector<Experiment>& experiments) const {
    std::vector<std::string> sections;
    std::vector<NotRun> not_run;
    for (const Experiment& experiment : experiments) {
        const std::string full = contents(folder_of(experiment, Effort::full) / kSectionFile);
        const std::string quick = contents(folder_of(experiment, Effort::quick) / kSectionFile);
        std::string section = section_of_both(full, quick);
        if (!section.empty())
            sections.push_back(std::move(section));
        else if (!full.empty() || !quick.empty())
            not_run.push_back(
                {experiment.name, (folder_ / experiment.name).string() + " is damaged; run it again"});
        else if (const std::string obstacle = experiment.obstacle(); !obstacle.empty())
            not_run.push_back({experiment.name, obstacle});
        else
            not_run.push_back({experiment.name, "not run into this folder"});
    }
    const std::filesystem::path path = folder_ / "index.html";
    write_text(path, page_of(sections, not_run));
    return path;
}

} // namespace nusselt::lab
