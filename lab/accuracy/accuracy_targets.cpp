#include "lab/accuracy/accuracy_targets.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace nusselt::lab {

namespace {

using Q = AccuracyQuantity;

constexpr const char* kPolygon = "PolygonProjectedSolidAngle";
constexpr const char* kLine = "LineProjectedSolidAngle";

constexpr AccuracyTarget kTargets[] = {
    {kPolygon, "float", "decentral", Q::p99_over_floor, 10},
    {kPolygon, "float", "decentral", Q::off_the_light, 0},
    {kPolygon, "float", "central", Q::p99_over_floor, 10},
    {kPolygon, "float", "central", Q::off_the_light, 0},
    {kPolygon, "float", "crossing the horizon", Q::p99_over_floor, 10},
    {kPolygon, "float", "crossing the horizon", Q::off_the_light, 0},
    {kPolygon, "float", "square of 1 cm at 40 m", Q::p99_over_floor, 10},
    {kPolygon, "float", "square of 1 cm at 40 m", Q::off_the_light, 0},
    {kPolygon, "float", "square of 1 mm at 40 m", Q::p99_over_floor, 10},
    {kPolygon, "float", "square of 1 mm at 40 m", Q::off_the_light, 0},
    {kPolygon, "float", "close to the interior, 1e-3 of the size", Q::p99_over_floor, 30},
    {kPolygon, "float", "close to the interior, 1e-3 of the size", Q::max, 1e-3},
    {kPolygon, "float", "close to the interior, 1e-3 of the size", Q::off_the_light, 0},
    {kPolygon, "float", "close to the plane, beside the light", Q::p99_over_floor, 30},
    {kPolygon, "float", "close to the plane, beside the light", Q::max, 1e-3},
    {kPolygon, "float", "close to the plane, beside the light", Q::off_the_light, 0},
    {kPolygon, "float", "edge in a vertical plane through the point", Q::p99, 1e-5},
    {kPolygon, "float", "edge in a vertical plane through the point", Q::off_the_light, 0},
    // A repeated vertex that comes first changes the rounding, so the errors are equal apart from chance.
    {kPolygon, "float", "triangle with a repeated vertex", Q::p99_over_other, 1.2, "triangle"},
    {kPolygon, "float", "triangle with a repeated vertex", Q::off_the_light, 0},
    {kPolygon, "float", "no area", Q::spurious, 0},
    {kPolygon, "float", "edge-on", Q::spurious, 0},
    {kPolygon, "float", kEveryClass, Q::p999_over_floor, 100},
    {kPolygon, "float", kEveryClass, Q::invalid, 0},
    {kLine, "float", "ordinary", Q::p99_over_floor, 10},
    {kLine, "float", "crossing the horizon", Q::p99_over_floor, 10},
    {kLine, "float", "1 cm at 40 m", Q::p99_over_floor, 2},
    {kLine, "float", "1 mm at 40 m", Q::p99_over_floor, 2},
    {kLine, "float", "1e-3 of the length beside it", Q::p99_over_floor, 30},
    {kLine, "float", "1e-3 of the length beyond an end", Q::p99_over_floor, 30},
    {kLine, "float", "pointing at the point within 1e-4", Q::invalid, 0},
    {kLine, "float", "pointing at the point within 1e-4", Q::max_of_measure, 1e-3},
    {kLine, "float", "along an axis through the point", Q::invalid, 0},
    {kLine, "float", "along an axis through the point", Q::spurious, 0},
    {kLine, "float", "in the horizon plane", Q::invalid, 0},
    {kLine, "float", "in the horizon plane", Q::spurious, 0},
    {kLine, "float", kEveryClass, Q::p999_over_floor, 100},
    {kLine, "float", kEveryClass, Q::invalid, 0},
};

const proof::AccuracyRow* find(const std::vector<proof::AccuracyRow>& rows, const proof::AccuracyRow& like,
                               std::string_view lights, std::string_view method) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const proof::AccuracyRow& r) {
        return r.technique == like.technique && r.scalar == like.scalar && r.lights == lights &&
               r.method == method;
    });
    return found == rows.end() ? nullptr : &*found;
}

/// Is infinite without a row to compare with.
double value_of(const AccuracyTarget& target, const proof::AccuracyRow& row,
                const std::vector<proof::AccuracyRow>& rows) {
    const auto over = [&](const proof::AccuracyRow* other, double proof::ErrorQuantiles::*quantile) {
        return other == nullptr ? std::numeric_limits<double>::infinity()
                                : row.backward.*quantile / other->backward.*quantile;
    };
    switch (target.quantity) {
    case Q::p99_over_floor:
        return over(find(rows, row, row.lights, "floor"), &proof::ErrorQuantiles::p99);
    case Q::p999_over_floor:
        return over(find(rows, row, row.lights, "floor"), &proof::ErrorQuantiles::p999);
    case Q::p99_over_other:
        return over(find(rows, row, target.other, row.method), &proof::ErrorQuantiles::p99);
    case Q::p99:
        return row.backward.p99;
    case Q::max:
        return row.backward.max;
    case Q::max_of_measure:
        return row.measure.max;
    case Q::off_the_light:
        return static_cast<double>(row.off_the_light);
    case Q::invalid:
        return static_cast<double>(row.nan + row.infinite + row.negative);
    case Q::spurious:
        break;
    }
    return static_cast<double>(row.spurious);
}

bool concerns(const AccuracyTarget& target, const proof::AccuracyRow& row) {
    const bool every_class = std::string_view(target.lights) == kEveryClass;
    // Dark lights have results, but no backward errors.
    const bool has_quantity = !row.dark || target.quantity == Q::invalid || target.quantity == Q::spurious;
    const bool method = row.scalar == "float" ? row.method == "ours" || row.method == "ours, packs"
                                              : row.method == "ours, 2 steps";
    return row.technique == target.technique && row.scalar == target.scalar && method && has_quantity &&
           (every_class || row.lights == target.lights);
}

} // namespace

std::string describe(AccuracyQuantity quantity, const char* other, double limit) {
    switch (quantity) {
    case Q::p99_over_floor:
        return fmt::format("99 %: at most {:g} times the floor", limit);
    case Q::p999_over_floor:
        return fmt::format("99.9 %: at most {:g} times the floor", limit);
    case Q::p99_over_other:
        return fmt::format("99 %: at most {:g} times that of the {}", limit, other);
    case Q::p99:
        return fmt::format("99 %: at most {:g}", limit);
    case Q::max:
        return fmt::format("largest: at most {:g}", limit);
    case Q::max_of_measure:
        return fmt::format("error of the measure: at most {:g}", limit);
    case Q::off_the_light:
        return fmt::format("off the light: {:g}", limit);
    case Q::invalid:
        return fmt::format("NaN, infinite or negative: {:g}", limit);
    case Q::spurious:
        break;
    }
    return fmt::format("sample or measure: {:g}", limit);
}

std::vector<AccuracyVerdict> check_targets(const std::vector<proof::AccuracyRow>& rows) {
    std::vector<AccuracyVerdict> verdicts;
    for (const AccuracyTarget& target : kTargets) {
        AccuracyVerdict verdict{target, std::numeric_limits<double>::quiet_NaN(), target.lights, false};
        for (const proof::AccuracyRow& row : rows) {
            if (!concerns(target, row)) continue;
            const double value = value_of(target, row, rows);
            if (value <= verdict.value) continue;
            verdict.value = value;
            verdict.lights = row.lights;
        }
        verdict.met = verdict.value <= target.limit;
        verdicts.push_back(verdict);
    }
    return verdicts;
}

std::string where(const AccuracyVerdict& verdict) {
    const bool one_is_worst = verdict.lights != verdict.target.lights && verdict.value > 0;
    return one_is_worst ? fmt::format("{}; worst: {}", verdict.target.lights, verdict.lights)
                        : verdict.target.lights;
}

FloorRatios floor_ratios(const std::vector<proof::AccuracyRow>& rows, const proof::AccuracyRow& row) {
    const proof::AccuracyRow* const floor = find(rows, row, row.lights, "floor");
    if (floor == nullptr) return {};
    const auto ratio = [](double error, double least) {
        return least > 0 ? std::optional(error / least) : std::nullopt;
    };
    return {ratio(row.backward.p99, floor->backward.p99), ratio(row.backward.p999, floor->backward.p999)};
}

} // namespace nusselt::lab
