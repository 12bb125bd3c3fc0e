#include "lab/figures/report_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace nusselt::lab {

namespace {

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;max-width:80em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse;margin:1em 0}td,th{padding:.3em 1em;border-bottom:1px solid "
    "#ccc;text-align:right}"
    "td:first-child,th:first-child{text-align:left}figure{display:inline-block;margin:.5em}"
    "img{max-width:100%;image-rendering:pixelated}.no{color:#b00}";

} // namespace

std::string to_text(const Table& table) {
    std::vector<std::size_t> widths(table[0].size());
    for (const auto& row : table)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const auto& row : table) {
        text += fmt::format("{:<{}}", row[0], widths[0]);
        for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
        text += "\n";
    }
    return text;
}

std::string to_text(const std::vector<ExpectationResult>& expectations) {
    std::string text;
    for (const ExpectationResult& e : expectations)
        text += fmt::format("{}: {}\n", e.holds ? "holds" : "DOES NOT HOLD", e.text);
    return text;
}

std::string to_html(const Table& table) {
    std::string html = "<table>\n";
    for (const auto& row : table) {
        html += "<tr>";
        for (const std::string& cell : row) html += (&row == &table[0] ? "<th>" : "<td>") + cell;
        html += "\n";
    }
    return html + "</table>\n";
}

std::string to_html(const std::vector<ExpectationResult>& expectations) {
    std::string html = "<ul>\n";
    for (const ExpectationResult& e : expectations)
        html += fmt::format("<li{}>{}: {}\n", e.holds ? "" : " class=\"no\"", e.text,
                            e.holds ? "holds" : "does not hold");
    return html + "</ul>\n";
}

std::string page_head(const std::string& title) {
    return fmt::format("<!DOCTYPE html>\n<meta charset=\"utf-8\"><title>{0}</title><style>{1}</style>\n"
                       "<h1>{0}</h1>\n",
                       title, kStyle);
}

} // namespace nusselt::lab
