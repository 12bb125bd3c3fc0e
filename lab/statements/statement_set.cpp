#include "lab/statements/statement_set.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace nusselt::lab {

namespace {

std::string expected_of(const Finding& f) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (f.low == f.high) return fmt::format("{:.4g}", f.low);
    if (f.low == -kInfinity) return fmt::format("at most {:.4g}", f.high);
    if (f.high == kInfinity) return fmt::format("at least {:.4g}", f.low);
    return fmt::format("{:.4g} to {:.4g}", f.low, f.high);
}

Table table_of(const std::vector<Finding>& findings) {
    Table table = {{"statement", "quantity", "measured", "expected"}};
    for (const Finding& f : findings)
        table.push_back({f.item, f.quantity, fmt::format("{:.4g}", f.measured), expected_of(f)});
    return table;
}

Results numbers_of(const StatementSetResult& result) {
    ResultTable findings = {"findings", {{"item"}, {"quantity"}, {"measured"}, {"low"}, {"high"}}};
    const auto limit = [](double x) { return std::isfinite(x) ? Cell(x) : Cell(nullptr); };
    for (const Finding& f : result.findings.all)
        findings.rows.push_back({f.item, f.quantity, f.measured, limit(f.low), limit(f.high)});
    return {result.set.name, {}, {std::move(findings)}};
}

} // namespace

Finding at_most(std::string item, std::string quantity, double measured, double limit) {
    Finding finding{std::move(item), std::move(quantity), measured};
    finding.high = limit;
    return finding;
}

Finding at_least(std::string item, std::string quantity, double measured, double limit) {
    Finding finding{std::move(item), std::move(quantity), measured};
    finding.low = limit;
    return finding;
}

Finding between(std::string item, std::string quantity, double measured, double low, double high) {
    return {std::move(item), std::move(quantity), measured, low, high};
}

bool holds(const Finding& finding) {
    return finding.measured >= finding.low && finding.measured <= finding.high;
}

StatementSetResult run_statement_set(const StatementSet& set, const RunSettings& /*one thread suffices*/,
                                     const ProgressText& progress) {
    progress(set.description);
    return {set, set.measure(set.effort)};
}

Report report_of(const StatementSetResult& result) {
    Report report;
    report.tables = result.findings.tables;
    report.tables.insert(report.tables.begin(), table_of(result.findings.all));
    for (const Finding& f : result.findings.all) {
        report.expectations.push_back(checked(
            fmt::format("{}, {}: {:.4g}, {}", f.item, f.quantity, f.measured, expected_of(f)), holds(f)));
        if (!f.published.empty()) report.measured.push_back({f.item, f.published, f.measured});
    }
    report.plots = result.findings.plots;
    report.drawings = result.findings.drawings;
    report.numbers = numbers_of(result);
    return report;
}

} // namespace nusselt::lab
