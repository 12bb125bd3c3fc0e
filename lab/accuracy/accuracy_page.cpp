#include "lab/accuracy/accuracy_page.h"

#include "lab/accuracy/accuracy_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nusselt::lab {

namespace {

using Line = std::vector<std::string>;

/// A Markdown table, padded so that it reads well as plain text too.
std::string render(const std::vector<Line>& lines) {
    std::vector<std::size_t> widths(lines.front().size(), 0);
    for (const Line& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    std::string text;
    for (const Line& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) text += fmt::format("| {:<{}} ", line[i], widths[i]);
        text += "|\n";
        if (&line != &lines.front()) continue;
        for (const std::size_t width : widths) text += "|" + std::string(width + 2, '-');
        text += "|\n";
    }
    return text + "\n";
}

std::string number(double x) { return x == 0 ? "0" : fmt::format("{:.1e}", x); }

std::string ratio(double x, double floor) { return floor > 0 ? fmt::format("{:.2g}", x / floor) : ""; }

std::string share(std::int64_t part, std::int64_t whole) {
    return part == 0 ? "0"
                     : fmt::format("{:.2g} %", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string invalid(const proof::AccuracyRow& r) {
    return fmt::format("{} / {} / {}", r.nan, r.infinite, r.negative);
}

std::string target_table(const std::vector<proof::AccuracyRow>& rows) {
    std::vector<Line> lines{{"technique", "number type", "lights", "target", "measured", "met"}};
    for (const AccuracyVerdict& v : check_targets(rows)) {
        const AccuracyTarget& t = v.target;
        const bool one_is_worst = v.lights != t.lights && v.value > 0;
        const std::string where = one_is_worst ? fmt::format("{}; worst: {}", t.lights, v.lights) : t.lights;
        lines.push_back({t.technique, t.scalar, where, describe(t.quantity, t.other, t.limit),
                         std::isnan(v.value) ? "no such row" : fmt::format("{:.3g}", v.value),
                         v.met ? "yes" : "**missed**"});
    }
    return render(lines);
}

using Rows = std::vector<const proof::AccuracyRow*>;

/// The name of the lights, in the first of the rows that share it.
std::string name_once(const Rows& rows, const proof::AccuracyRow* row) {
    const auto first = std::find_if(rows.begin(), rows.end(),
                                    [&](const proof::AccuracyRow* r) { return r->lights == row->lights; });
    return *first == row ? row->lights : "";
}

/// The rows of one technique and number type with something to sample.
std::string lit_table(const Rows& rows) {
    std::vector<Line> lines{{"lights", "method", "backward error: median", "99 %", "99.9 %", "largest",
                             "99 % / floor", "99.9 % / floor", "measure: median", "99 %", "99.9 %", "largest",
                             "off the light", "no sample", "NaN / inf / negative"}};
    for (const proof::AccuracyRow* r : rows) {
        const auto floor = std::find_if(rows.begin(), rows.end(), [&](const proof::AccuracyRow* other) {
            return other->lights == r->lights && other->method == "floor";
        });
        const proof::ErrorQuantiles least =
            floor == rows.end() ? proof::ErrorQuantiles{} : (*floor)->backward;
        lines.push_back({name_once(rows, r), r->method, number(r->backward.median), number(r->backward.p99),
                         number(r->backward.p999), number(r->backward.max), ratio(r->backward.p99, least.p99),
                         ratio(r->backward.p999, least.p999), number(r->measure.median),
                         number(r->measure.p99), number(r->measure.p999), number(r->measure.max),
                         share(r->off_the_light, r->count), share(r->no_sample, r->count), invalid(*r)});
    }
    return lines.size() > 1 ? render(lines) : "";
}

std::string dark_table(const Rows& rows) {
    std::vector<Line> lines{{"lights with nothing to sample", "method", "sample or measure",
                             "largest measure", "NaN / inf / negative"}};
    for (const proof::AccuracyRow* r : rows)
        lines.push_back(
            {r->lights, r->method, share(r->spurious, r->count), number(r->measure.max), invalid(*r)});
    return lines.size() > 1 ? render(lines) : "";
}

constexpr const char* kIntroduction = R"(# Accuracy of the samplers

`nusselt-lab bench accuracy --json docs/accuracy.json --markdown docs/accuracy.md` generates this page; do not edit it.
The tests measure again and fail if a row of ours gets worse (docs/testing.md).

Each class has {count} random lights, rounded to float so that every number type gets the same lights. Each light gets
one sample. Lights with a measure below 1e-12 are excluded. The reference is the exact technique in long double, with
more steps of the iteration than any method under test.

Methods:

- *plain*: a transcription of the published formulas (`include/nusselt/related`). It does not support unused slots for
  vertices, and not every technique has such a transcription.
- *ours*: the library, as scalar code for x86-64-v2.
- *ours, packs*: the library in the packs of the largest instruction set of the machine that generated this page
  ({isa}), compiled as for `nusselt-lab bench samplers`.
- *ours, 2 steps*: in long double, with as many steps of the iteration as float takes. This is the error of the method
  without rounding. *ours* in long double takes as many steps as in double. Techniques without iteration have no rows in
  long double, because they are their own reference.
- *floor*: exact directions, rounded to the number type. No method can be expected to be better. The biased variant has
  no target relative to a floor, because its error is by design and its reference is the exact technique.

Columns:

- *backward error*: the change of the first random number that would make the exact technique return the computed
  direction, by quantiles. Random numbers are cyclic if the zenith is in the light. *99 % / floor* is the 99 % quantile
  over that of the floor.
- *measure*: relative error of area, length, solid angle or projected solid angle.
- *off the light*: the share of directions that miss the light, or the upper hemisphere if the technique clips to it, by
  more than four roundings.
- *no sample*: the share of lights without a sample although a part of the light can be sampled.
- *NaN / inf / negative*: the number of lights for which a direction, density or measure is NaN or infinite, or for
  which a density or measure is below 0. The other columns exclude these lights.
- *sample or measure*: the share of lights that got a sample or a measure although they have no area, are seen edge-on,
  or are below the horizon or on a line through the shading point. For techniques for areas and lengths, which have a
  measure for such lights, only samples count. *largest measure* is absolute.

)";

} // namespace

std::string accuracy_tables(const AccuracyTable& table) {
    std::string text =
        "## Targets\n\nThe larger value of scalar code and packs counts.\n\n" + target_table(table.rows);
    for (const proof::AccuracyRow& first : table.rows) {
        const auto same = [&](const proof::AccuracyRow& r) {
            return r.technique == first.technique && r.scalar == first.scalar;
        };
        if (&*std::find_if(table.rows.begin(), table.rows.end(), same) != &first) continue;
        Rows lit, dark;
        for (const proof::AccuracyRow& r : table.rows)
            if (same(r)) (r.dark ? dark : lit).push_back(&r);
        text +=
            fmt::format("## {}, {}\n\n", first.technique, first.scalar) + lit_table(lit) + dark_table(dark);
    }
    text.pop_back();
    return text;
}

std::string accuracy_page(const AccuracyTable& table) {
    return fmt::format(fmt::runtime(kIntroduction), fmt::arg("count", table.count),
                       fmt::arg("isa", table.isa)) +
           accuracy_tables(table);
}

} // namespace nusselt::lab
