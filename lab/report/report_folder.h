#pragma once
/// The folder into which `nusselt-lab reproduce` writes. It keeps what was run before: runs add up to one page, and an
/// experiment runs again only if the program, its settings, the machine or one of its files has changed. Full and quick
/// reports have folders of their own, NAME/full and NAME/quick: hours of work never give way to a quick run.

#include "lab/report/page.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// What is known about an experiment that is not run again.
struct KeptReport {
    std::string date;
    Verdict verdict;
};

class ReportFolder {
public:
    /// Creates the folder. \throws std::runtime_error if that fails
    explicit ReportFolder(std::filesystem::path folder);

    /// Finds out before hours of work whether the files of an experiment and the page can be written.
    /// \throws std::runtime_error
    void check_writable(const Experiment& experiment, Effort effort) const;

    /// The report of an earlier run that would have the same numbers today, up to times. One with full effort counts as a
    /// quick one, too.
    std::optional<KeptReport> kept(const Experiment& experiment, const RunSettings& settings) const;

    /// Writes numbers.json, images as EXR and PNG, plots as SVG and the section of the page into the folder of the
    /// experiment and effort. \throws std::runtime_error
    void write(const Experiment& experiment, const Report& report, const RunSettings& settings,
               const RunRecord& record) const;

    /// Writes index.html with all experiments that the folder has: full reports where there are any, with the expectations
    /// of a quick run that came later. \returns its path. \throws std::runtime_error
    std::filesystem::path write_page(const std::vector<Experiment>& experiments) const;

private:
    std::filesystem::path folder_of(const Experiment& experiment, Effort effort) const;
    std::optional<KeptReport> kept_in(const std::filesystem::path& folder, const std::string& key) const;

    std::filesystem::path folder_;
    std::string program_; ///< fingerprint
};

/// A name for a file: the label, with hyphens in place of everything but letters, digits and underscores.
std::string file_stem(const std::string& label);

} // namespace nusselt::lab
