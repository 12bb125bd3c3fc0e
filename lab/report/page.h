#pragma once
/// The page of `nusselt-lab reproduce`: one file that opens from disk, with all images and numbers in it. The browser builds
/// it from JSON (lab/report/page/).

#include "lab/report/experiment.h"

#include <string>
#include <vector>

namespace nusselt::lab {

/// When and how a report came to be.
struct RunRecord {
    std::string command; ///< that runs the experiment again
    std::string date;    ///< of the beginning, ISO 8601 in UTC
    double seconds = 0;  ///< of wall time
};

/// The part of the page about one experiment, as an object of JSON.
std::string page_section(const Experiment& experiment, const Report& report, Effort effort,
                         const RunRecord& record);

/// Why an experiment is not in the page.
struct NotRun {
    std::string name;
    std::string reason;
};

/// A section as page_section() writes it, from the text of a file. Empty if the text is none.
std::string checked_section(const std::string& text);

/// The section of an experiment with a full and a quick report: the full one, with the expectations of the quick one if
/// that came later. Where only one text is a section, that one; where none is, empty.
std::string section_of_both(const std::string& full, const std::string& quick);

/// The page.
/// \param sections of page_section() or checked_section()
std::string page_of(const std::vector<std::string>& sections, const std::vector<NotRun>& not_run);

/// A PNG of twice the height of an image: mantissas above, the exponents that the channels of a pixel share below. A channel
/// is (mantissa + 0.5) * 2^(exponent - 136), and 0 where the exponent is 0. Exponents of 255 are pixels that are NaN or
/// infinite. Negative values become 0.
std::string rgbe_stacked_png(const image::Image& image);

} // namespace nusselt::lab
