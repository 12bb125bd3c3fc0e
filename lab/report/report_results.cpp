#include "lab/report/report_results.h"

#include <cmath>

namespace nusselt::lab {

ResultTable expectation_table(const std::vector<ExpectationResult>& expectations) {
    ResultTable table = {"expectations", {{"expectation"}, {"holds"}, {"reason"}}};
    for (const ExpectationResult& e : expectations)
        table.rows.push_back(
            {e.text, e.verdict == Verdict::not_evaluated ? Cell(nullptr) : Cell(e.verdict == Verdict::holds),
             e.reason});
    return table;
}

std::vector<Column> curve_columns(std::vector<Column> names) {
    names.insert(names.end(),
                 {{"count"}, {"seeds"}, {"variance"}, {"error"}, {"seconds", "s"}, {"variance_error"}});
    return names;
}

void append_curve(const std::vector<Cell>& names, const NoiseCurve& curve, double mean, ResultTable& table) {
    for (const CurvePoint& p : curve) {
        std::vector<Cell>& row = table.rows.emplace_back(names);
        row.insert(row.end(),
                   {p.count, p.seeds, p.variance, std::sqrt(p.variance) / mean, p.seconds, p.variance_error});
    }
}

} // namespace nusselt::lab
