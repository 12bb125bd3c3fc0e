#include "lab/accuracy/accuracy_json.h"

#include "lab/accuracy/accuracy_targets.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <functional>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRows = "rows";

/// A column of the table of rows.
struct RowColumn {
    const char* name;
    std::function<Cell(const proof::AccuracyRow&)> get;
    std::function<void(const Json&, proof::AccuracyRow&)> set;
};

template <class Value>
RowColumn member(const char* name, Value proof::AccuracyRow::*value) {
    return {name, [value](const proof::AccuracyRow& row) { return Cell(row.*value); },
            [value](const Json& cell, proof::AccuracyRow& row) { cell.get_to(row.*value); }};
}

RowColumn quantile(const char* name, proof::ErrorQuantiles proof::AccuracyRow::*error,
                   double proof::ErrorQuantiles::*value) {
    return {name, [=](const proof::AccuracyRow& row) { return Cell(row.*error.*value); },
            [=](const Json& cell, proof::AccuracyRow& row) { cell.get_to(row.*error.*value); }};
}

const std::vector<RowColumn>& row_columns() {
    using Row = proof::AccuracyRow;
    using Error = proof::ErrorQuantiles;
    static const std::vector<RowColumn> columns = {
        member("technique", &Row::technique),
        member("scalar", &Row::scalar),
        member("lights", &Row::lights),
        member("method", &Row::method),
        member("count", &Row::count),
        member("dark", &Row::dark),
        quantile("backward_median", &Row::backward, &Error::median),
        quantile("backward_p99", &Row::backward, &Error::p99),
        quantile("backward_p999", &Row::backward, &Error::p999),
        quantile("backward_max", &Row::backward, &Error::max),
        quantile("measure_median", &Row::measure, &Error::median),
        quantile("measure_p99", &Row::measure, &Error::p99),
        quantile("measure_p999", &Row::measure, &Error::p999),
        quantile("measure_max", &Row::measure, &Error::max),
        member("off_the_light", &Row::off_the_light),
        member("no_sample", &Row::no_sample),
        member("spurious", &Row::spurious),
        member("nan", &Row::nan),
        member("infinite", &Row::infinite),
        member("negative", &Row::negative)};
    return columns;
}

ResultTable row_table(const std::vector<proof::AccuracyRow>& rows) {
    ResultTable table = {kRows, {}};
    for (const RowColumn& column : row_columns()) table.columns.push_back({column.name});
    table.columns.insert(table.columns.end(), {{"p99_over_floor"}, {"p999_over_floor"}});
    for (const proof::AccuracyRow& row : rows) {
        std::vector<Cell>& cells = table.rows.emplace_back();
        for (const RowColumn& column : row_columns()) cells.push_back(column.get(row));
        const FloorRatios over_floor = row.dark ? FloorRatios{} : floor_ratios(rows, row);
        cells.push_back(cell_of(over_floor.p99));
        cells.push_back(cell_of(over_floor.p999));
    }
    return table;
}

ResultTable target_table(const std::vector<proof::AccuracyRow>& rows) {
    ResultTable table = {"targets",
                         {{"technique"}, {"scalar"}, {"lights"}, {"target"}, {"measured"}, {"met"}}};
    for (const AccuracyVerdict& v : check_targets(rows)) {
        const AccuracyTarget& t = v.target;
        table.rows.push_back({std::string(t.technique), std::string(t.scalar), where(v),
                              describe(t.quantity, t.other, t.limit), v.value, v.met});
    }
    return table;
}

proof::AccuracyRow read_row(const Json& columns, const Json& cells) {
    proof::AccuracyRow row;
    for (const RowColumn& column : row_columns()) {
        const auto found = std::find_if(columns.begin(), columns.end(),
                                        [&](const Json& c) { return c.at("name") == column.name; });
        column.set(cells.at(static_cast<std::size_t>(found - columns.begin())), row);
    }
    return row;
}

bool is_ours(const proof::AccuracyRow& row) { return row.method.rfind("ours", 0) == 0; }

bool same_row(const proof::AccuracyRow& a, const proof::AccuracyRow& b) {
    return a.technique == b.technique && a.scalar == b.scalar && a.lights == b.lights && a.method == b.method;
}

std::string name(const proof::AccuracyRow& r) {
    return fmt::format("{}, {}, {}, {}", r.technique, r.scalar, r.lights, r.method);
}

/// Reports the rows of the library's own methods that one table has and the other lacks.
void report_missing(const AccuracyTable& from, const AccuracyTable& in, const char* complaint,
                    std::vector<std::string>& complaints) {
    for (const proof::AccuracyRow& r : from.rows)
        if (is_ours(r) && std::none_of(in.rows.begin(), in.rows.end(),
                                       [&](const proof::AccuracyRow& other) { return same_row(r, other); }))
            complaints.push_back(name(r) + ": " + complaint);
}

} // namespace

Results results_of(const AccuracyTable& table) {
    return {"accuracy",
            {{"count", table.count}, {"isa", table.isa}},
            {target_table(table.rows), row_table(table.rows)}};
}

AccuracyTable read_accuracy_json(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path.string() + ": cannot read the file");
    try {
        const Json json = Json::parse(file);
        const Json& settings = json.at("settings");
        AccuracyTable table{settings.at("count").get<int>(), settings.at("isa").get<std::string>(), {}};
        for (const Json& part : json.at("tables"))
            if (part.at("name") == kRows)
                for (const Json& cells : part.at("rows"))
                    table.rows.push_back(read_row(part.at("columns"), cells));
        return table;
    } catch (const Json::exception& error) {
        throw std::runtime_error(path.string() + ": the file is not a table of accuracies: " + error.what());
    }
}

std::vector<std::string> compare_with_baseline(const AccuracyTable& baseline, const AccuracyTable& measured,
                                               const AccuracyMargin& margin) {
    std::vector<std::string> complaints;
    report_missing(baseline, measured, "is missing in the measurement", complaints);
    report_missing(measured, baseline, "is missing in the baseline", complaints);
    for (const proof::AccuracyRow& now : measured.rows) {
        if (!is_ours(now)) continue;
        const auto before = std::find_if(baseline.rows.begin(), baseline.rows.end(),
                                         [&](const proof::AccuracyRow& r) { return same_row(r, now); });
        if (before == baseline.rows.end()) continue;
        const auto compare = [&](const std::string& quantity, double value, double reference, double factor) {
            if (!(value <= factor * reference))
                complaints.push_back(
                    fmt::format("{}: {}: {:g}, was {:g}", name(now), quantity, value, reference));
        };
        const auto compare_quantiles = [&](const std::string& error, const proof::ErrorQuantiles& value,
                                           const proof::ErrorQuantiles& reference) {
            compare(error + ", median", value.median, reference.median, margin.quantiles);
            compare(error + ", 99 %", value.p99, reference.p99, margin.quantiles);
            compare(error + ", 99.9 %", value.p999, reference.p999, margin.quantiles);
            compare(error + ", largest", value.max, reference.max,
                    now.scalar == "long double" ? margin.max_of_long_double : margin.max);
        };
        compare_quantiles("backward error", now.backward, before->backward);
        compare_quantiles("error of the measure", now.measure, before->measure);
        const auto compare_count = [&](const char* quantity, std::int64_t proof::AccuracyRow::*count) {
            compare(quantity, static_cast<double>(now.*count), static_cast<double>((*before).*count),
                    margin.counts);
        };
        compare_count("off the light", &proof::AccuracyRow::off_the_light);
        compare_count("without a sample", &proof::AccuracyRow::no_sample);
        compare_count("spurious samples or measures", &proof::AccuracyRow::spurious);
        compare_count("NaN", &proof::AccuracyRow::nan);
        compare_count("infinite", &proof::AccuracyRow::infinite);
        compare_count("negative", &proof::AccuracyRow::negative);
        if (now.count != before->count || now.dark != before->dark)
            complaints.push_back(name(now) + ": the lights differ from the baseline");
    }
    return complaints;
}

} // namespace nusselt::lab
