#include "lab/report/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace nusselt::lab {

namespace {

/// In characters: bytes of UTF-8 that continue one do not count.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

} // namespace

ExpectationResult checked(std::string text, bool holds) {
    return {std::move(text), holds ? Verdict::holds : Verdict::fails};
}

ExpectationResult not_evaluated(std::string text, std::string reason) {
    return {std::move(text), Verdict::not_evaluated, std::move(reason)};
}

Verdict verdict_of(const std::vector<ExpectationResult>& expectations) {
    const auto any = [&](Verdict verdict) {
        return std::any_of(expectations.begin(), expectations.end(),
                           [&](const ExpectationResult& e) { return e.verdict == verdict; });
    };
    if (any(Verdict::fails)) return Verdict::fails;
    return any(Verdict::not_evaluated) ? Verdict::not_evaluated : Verdict::holds;
}

std::string to_text(const Table& table) {
    std::vector<std::size_t> widths(table[0].size());
    for (const auto& row : table)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
    std::string text;
    for (const auto& row : table) {
        text += row[0] + std::string(widths[0] - width_of(row[0]), ' ');
        for (std::size_t i = 1; i < row.size(); ++i)
            text += "  " + std::string(widths[i] - width_of(row[i]), ' ') + row[i];
        text += "\n";
    }
    return text;
}

std::string to_text(const std::vector<ExpectationResult>& expectations) {
    std::string text;
    for (const ExpectationResult& e : expectations) {
        switch (e.verdict) {
        case Verdict::holds:
            text += fmt::format("holds: {}\n", e.text);
            break;
        case Verdict::fails:
            text += fmt::format("DOES NOT HOLD: {}\n", e.text);
            break;
        case Verdict::not_evaluated:
            text += fmt::format("NOT EVALUATED ({}): {}\n", e.reason, e.text);
            break;
        }
    }
    return text;
}

std::string to_text(const Report& report) {
    std::string text = report.setting.empty() ? "" : report.setting + "\n";
    for (const Table& table : report.tables) text += "\n" + to_text(table);
    if (!report.expectations.empty()) text += "\n" + to_text(report.expectations);
    return text;
}

} // namespace nusselt::lab
