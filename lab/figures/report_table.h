#pragma once
/// The parts of reports, as text and as HTML.

#include <string>
#include <vector>

namespace nusselt::lab {

/// The first row and the first column are headings. Rows may be shorter than the first one.
using Table = std::vector<std::vector<std::string>>;

struct ExpectationResult {
    std::string text;
    bool holds = false;
};

/// Aligned columns.
std::string to_text(const Table& table);

/// A line for each.
std::string to_text(const std::vector<ExpectationResult>& expectations);

std::string to_html(const Table& table);

std::string to_html(const std::vector<ExpectationResult>& expectations);

/// The beginning of a page, up to its heading.
std::string page_head(const std::string& title);

} // namespace nusselt::lab
