#include "lab/accuracy/accuracy_text.h"

#include "lab/accuracy/accuracy_targets.h"
#include "lab/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nusselt::lab {

namespace {

std::string number(double x) { return x == 0 ? "0" : fmt::format("{:.1e}", x); }

std::string ratio(const std::optional<double>& ratio) { return ratio ? fmt::format("{:.2g}", *ratio) : ""; }

std::string share(std::int64_t part, std::int64_t whole) {
    if (part == 0) return "0";
    const double percent = 100 * static_cast<double>(part) / static_cast<double>(whole);
    return percent < 99 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

std::string invalid(const proof::AccuracyRow& r) {
    return fmt::format("{} / {} / {}", r.nan, r.infinite, r.negative);
}

Table target_table(const std::vector<proof::AccuracyRow>& rows) {
    Table table = {{"technique", "number type", "lights", "target", "measured", "met"}};
    for (const AccuracyVerdict& v : check_targets(rows)) {
        const AccuracyTarget& t = v.target;
        table.push_back({t.technique, t.scalar, where(v), describe(t.quantity, t.other, t.limit),
                         std::isnan(v.value) ? "no such row" : fmt::format("{:.3g}", v.value),
                         v.met ? "yes" : "MISSED"});
    }
    return table;
}

using Rows = std::vector<const proof::AccuracyRow*>;

/// A table of the rows of one technique and number type that have something to sample.
Table lit_table(const std::vector<proof::AccuracyRow>& all, const Rows& rows) {
    Table table = {{"lights", "method", "backward error: median", "99 %", "99.9 %", "largest", "99 % / floor",
                    "99.9 % / floor", "measure: median", "99 %", "99.9 %", "largest", "off the light",
                    "no sample", "NaN / inf / negative"}};
    for (const proof::AccuracyRow* r : rows) {
        const FloorRatios over_floor = floor_ratios(all, *r);
        table.push_back({r->lights, r->method, number(r->backward.median), number(r->backward.p99),
                         number(r->backward.p999), number(r->backward.max), ratio(over_floor.p99),
                         ratio(over_floor.p999), number(r->measure.median), number(r->measure.p99),
                         number(r->measure.p999), number(r->measure.max), share(r->off_the_light, r->count),
                         share(r->no_sample, r->count), invalid(*r)});
    }
    return table;
}

Table dark_table(const Rows& rows) {
    Table table = {{"lights with nothing to sample", "method", "sample or measure", "largest measure",
                    "NaN / inf / negative"}};
    for (const proof::AccuracyRow* r : rows)
        table.push_back(
            {r->lights, r->method, share(r->spurious, r->count), number(r->measure.max), invalid(*r)});
    return table;
}

} // namespace

std::string to_text(const AccuracyTable& table) {
    std::string text =
        "Targets (the larger value of scalar code and packs counts)\n\n" + to_text(target_table(table.rows));
    for (const proof::AccuracyRow& first : table.rows) {
        const auto same = [&](const proof::AccuracyRow& r) {
            return r.technique == first.technique && r.scalar == first.scalar;
        };
        if (&*std::find_if(table.rows.begin(), table.rows.end(), same) != &first) continue;
        Rows lit, dark;
        for (const proof::AccuracyRow& r : table.rows)
            if (same(r)) (r.dark ? dark : lit).push_back(&r);
        text += fmt::format("\n{}, {}\n", first.technique, first.scalar);
        if (!lit.empty()) text += "\n" + to_text(lit_table(table.rows, lit));
        if (!dark.empty()) text += "\n" + to_text(dark_table(dark));
    }
    return text;
}

} // namespace nusselt::lab
