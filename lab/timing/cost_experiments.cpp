#include "lab/timing/cost_experiments.h"

#include "base/isa.h"
#include "lab/report/published_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

namespace {

constexpr const char* kDecentral = "decentral";
constexpr const char* kCentral = "central";
constexpr const char* kAbove = "above the horizon";
constexpr const char* kCrossing = "crossing the horizon";
constexpr const char* kQuadrilateral = "decentral, 4 vertices";

CostTable polygon_costs() {
    return {"polygon-costs",
            "Peters 2021, polygonal lights, Table 1",
            "Cost of the techniques for polygons on one thread, without that of a baseline.",
            "polygons-table-1",
            {{"area", "PolygonArea", kDecentral},
             {"rectangle, Ureña et al.", "RectangleSolidAngle", kDecentral},
             {"solid angle, Arvo", "PolygonSolidAngleArvo", kDecentral},
             {"solid angle, Peters' formulas", "PolygonSolidAnglePeters", kDecentral},
             {"solid angle, ours", "PolygonSolidAngle", kDecentral},
             {"clipped solid angle, ours", "PolygonClippedSolidAngle", kDecentral},
             {"bilinear, Hart et al.", "PolygonBilinearWarpHart", kDecentral},
             {"biquadratic, Hart et al.", "PolygonBiquadraticWarpHart", kDecentral},
             {"projected, central, Arvo", "PolygonProjectedSolidAngleArvo", kCentral},
             {"projected, central, Peters' formulas", "PolygonProjectedSolidAnglePeters", kCentral},
             {"projected, central, ours", "PolygonProjectedSolidAngle", kCentral},
             {"biased, central, ours", "PolygonProjectedSolidAngleBiased", kCentral},
             {"projected, decentral, Arvo", "PolygonProjectedSolidAngleArvo", kDecentral},
             {"projected, decentral, bisection", "PolygonProjectedSolidAngleBisection", kDecentral},
             {"projected, decentral, subdivision", "PolygonSubdivisionUrena", kDecentral},
             {"projected, decentral, Peters' formulas", "PolygonProjectedSolidAnglePeters", kDecentral},
             {"projected, decentral, ours", "PolygonProjectedSolidAngle", kDecentral},
             {"biased, decentral, ours", "PolygonProjectedSolidAngleBiased", kDecentral},
             {"projected, crossing the horizon, Arvo", "PolygonProjectedSolidAngleArvo", kCrossing},
             {"projected, crossing the horizon, ours", "PolygonProjectedSolidAngle", kCrossing}},
            {3, 4, 5, 6, 7},
            4,
            {{"projected, central, Arvo", "projected, central, ours"},
             {"projected, decentral, Arvo", "projected, decentral, ours"},
             {"projected, crossing the horizon, Arvo", "projected, crossing the horizon, ours"},
             {"projected, decentral, bisection", "projected, decentral, ours"},
             {"projected, decentral, subdivision", "projected, decentral, ours"},
             {"solid angle, Arvo", "solid angle, ours"},
             {"biquadratic, Hart et al.", "bilinear, Hart et al."},
             {"projected, decentral, ours", "biased, decentral, ours"},
             {"projected, central, ours", "projected, central, Peters' formulas"},
             {"projected, decentral, ours", "projected, decentral, Peters' formulas"},
             {"solid angle, ours", "solid angle, Peters' formulas"}},
            {{"polygons-sec-6.6-arvo-ratio", "gain in speed, decentral", Cost::lights,
              "projected, decentral, Arvo", "projected, decentral, ours"},
             {"polygons-sec-6.6-arvo-ratio", "gain in speed, central, roughly", Cost::lights,
              "projected, central, Arvo", "projected, central, ours"},
             {"polygons-sec-6.6-biased-cost", "cost of a decentral sample, over that with iteration, roughly",
              Cost::samples, "biased, decentral, ours", "projected, decentral, ours"},
             {"polygons-sec-6.6-biased-cost", "cost over solid angle sampling, smallest", Cost::lights,
              "biased, central, ours", "solid angle, ours"},
             {"polygons-sec-6.6-biased-cost", "cost over solid angle sampling, largest", Cost::lights,
              "biased, decentral, ours", "solid angle, ours"},
             {"polygons-sec-6.6-warp-cost",
              "times with the biquadratic warp, over those with the bilinear one, roughly", Cost::lights,
              "biquadratic, Hart et al.", "bilinear, Hart et al."},
             {"polygons-sec-6.6-solid-angle-speed", "gain of a sample, 4 vertices", Cost::samples,
              "solid angle, Arvo", "solid angle, ours"}}};
}

CostTable line_costs() {
    return {
        "line-costs",
        "Peters 2021, linear lights, Table 1",
        "Cost of the techniques for linear lights on one thread, without that of a baseline.",
        "lines-table-1",
        {{"area", "LineArea", kAbove},
         {"solid angle, Peters' formulas", "LineSolidAnglePeters", kAbove},
         {"solid angle", "LineSolidAngle", kAbove},
         {"solid angle, crossing the horizon", "LineSolidAngle", kCrossing},
         {"clipped solid angle", "LineClippedSolidAngle", kAbove},
         {"clipped solid angle, crossing the horizon", "LineClippedSolidAngle", kCrossing},
         {"linear warp, Hart et al.", "LineClippedLinearWarpHart", kAbove},
         {"quadratic warp, Hart et al.", "LineClippedQuadraticWarpHart", kAbove},
         {"projected solid angle, Li et al.", "LineProjectedSolidAngleLi", kAbove},
         {"projected solid angle, Peters' formulas", "LineProjectedSolidAnglePeters", kAbove},
         {"projected solid angle, ours", "LineProjectedSolidAngle", kAbove},
         // In Fig. 1, neighbouring pixels take different numbers of steps. So do lines that cross the horizon: where
         // a pack has easy and hard ones, all lanes take as many steps as the hardest.
         {"Fig. 1: projected solid angle, Li et al.", "LineProjectedSolidAngleLi", kCrossing},
         {"Fig. 1: projected solid angle, ours", "LineProjectedSolidAngle", kCrossing},
         {"rectangle of a line, Ureña et al.", "LineRectangleUrena", kAbove},
         {"rectangle, Ureña et al.", "RectangleSolidAngle", kQuadrilateral},
         {"quad, projected solid angle", "PolygonProjectedSolidAngle", kQuadrilateral}},
        {0},
        0,
        {{"projected solid angle, Li et al.", "projected solid angle, ours"},
         {"Fig. 1: projected solid angle, Li et al.", "Fig. 1: projected solid angle, ours"},
         {"clipped solid angle", "solid angle"},
         {"quadratic warp, Hart et al.", "linear warp, Hart et al."},
         {"rectangle, Ureña et al.", "solid angle"},
         {"quad, projected solid angle", "projected solid angle, ours"},
         {"projected solid angle, ours", "projected solid angle, Peters' formulas"},
         {"solid angle", "solid angle, Peters' formulas"}},
        {{"lines-sec-5.4-li-ratio", "gain in speed per sample", Cost::samples,
          "projected solid angle, Li et al.", "projected solid angle, ours"},
         {"lines-sec-5.4-li-ratio", "gain in speed per light", Cost::lights,
          "projected solid angle, Li et al.", "projected solid angle, ours"},
         {"lines-sec-5.4-li-ratio", "gain in speed per sample, scene of Fig. 1", Cost::samples,
          "Fig. 1: projected solid angle, Li et al.", "Fig. 1: projected solid angle, ours"},
         {"lines-sec-5.4-clipping-cost", "cost per light with clipping, over that without", Cost::lights,
          "clipped solid angle, crossing the horizon", "solid angle, crossing the horizon"}}};
}

constexpr std::array kCosts = {Cost::lights, Cost::samples};

/// As published.json names the columns.
const char* name_of(Cost cost) { return cost == Cost::lights ? "128 lights" : "128 samples"; }

constexpr int kSamples = 128;

/// SamplerTiming::configuration
std::string configuration_of(const CostRow& row, int vertices) {
    return vertices == 0 ? row.lights : fmt::format("{}, {} vertices", row.lights, vertices);
}

const CostRow& row_named(const CostTable& table, const std::string& label) {
    const auto found = std::find_if(table.rows.begin(), table.rows.end(),
                                    [&](const CostRow& row) { return row.label == label; });
    if (found == table.rows.end()) throw std::logic_error("no row " + label);
    return *found;
}

/// Null if the technique does not take lights with so many vertices.
const SamplerTiming* find(const CostTableResult& result, const CostRow& row, int vertices,
                          const CostCode& code) {
    const std::string lights = configuration_of(row, vertices);
    const auto found = std::find_if(result.rows.begin(), result.rows.end(), [&](const SamplerTiming& timing) {
        return timing.technique == row.technique && timing.configuration == lights &&
               timing.code == code.code && timing.isa == code.isa;
    });
    return found == result.rows.end() ? nullptr : &*found;
}

double cost_of(const SamplerTiming& timing, Cost cost) {
    if (cost == Cost::lights) return *timing.once_ns;
    return *timing.sample_ns + *timing.prepare_ns / kSamples;
}

double spread_of(const SamplerTiming& timing, Cost cost) {
    return cost == Cost::lights ? *timing.once_spread_ns : *timing.sample_spread_ns;
}

/// [ns], without the baseline
std::optional<double> measured_cost(const CostTableResult& result, const CostRow& row, int vertices,
                                    Cost cost, const CostCode& code) {
    const SamplerTiming* const timing = find(result, row, vertices, code);
    if (timing == nullptr) return std::nullopt;
    return cost_of(*timing, cost);
}

std::string quantity_of(const CostRow& row, int vertices, Cost cost) {
    std::string quantity = fmt::format("{}, {}", row.label, name_of(cost));
    if (vertices > 0) quantity += fmt::format(", {} vertices", vertices);
    return quantity;
}

/// [ms] for a frame
std::optional<double> published_cost(const CostTable& table, const CostRow& row, int vertices, Cost cost) {
    return published_value(table.item, quantity_of(row, vertices, cost));
}

std::optional<double> ratio(const std::optional<double>& a, const std::optional<double>& b) {
    if (a && b) return *a / *b;
    return std::nullopt;
}

std::optional<double> published_ratio(const CostTable& table, const CostComparison& pair, int vertices,
                                      Cost cost) {
    return ratio(published_cost(table, row_named(table, pair.row), vertices, cost),
                 published_cost(table, row_named(table, pair.other), vertices, cost));
}

std::optional<double> measured_ratio(const CostTableResult& result, const CostComparison& pair, int vertices,
                                     Cost cost, const CostCode& code) {
    const CostTable& table = result.table;
    return ratio(measured_cost(result, row_named(table, pair.row), vertices, cost, code),
                 measured_cost(result, row_named(table, pair.other), vertices, cost, code));
}

/// A graphics processor runs as packs do.
const CostCode& packs_of(const CostTableResult& result) { return result.codes.at(1); }

std::string name_of(const CostCode& code) { return fmt::format("{}, {}", code.code, code.isa); }

/// What a published millisecond is here [ns]: the geometric mean over all cells, so that ratios can be read off.
double scale_of(const CostTableResult& result, const CostCode& code) {
    double sum = 0;
    int count = 0;
    for (const CostRow& row : result.table.rows)
        for (const int n : result.table.vertices)
            for (const Cost cost : kCosts) {
                const auto published = published_cost(result.table, row, n, cost);
                const auto measured = measured_cost(result, row, n, cost, code);
                // Rounding errors of a difference may make the cost of next to nothing negative.
                if (!published || !measured || *measured <= 0) continue;
                sum += std::log(*measured / *published);
                ++count;
            }
    if (count == 0) throw std::logic_error("nothing of " + result.table.item + " is measured");
    return std::exp(sum / count);
}

std::vector<std::string> vertex_headings(const CostTable& table) {
    std::vector<std::string> headings;
    for (const int n : table.vertices) headings.push_back(n == 0 ? "lines" : fmt::format("{} vertices", n));
    return headings;
}

std::string text_of(const std::optional<double>& number, int decimals) {
    return number ? fmt::format("{:.{}f}", *number, decimals) : "-";
}

/// Measured ± spread (published, scaled).
Table cost_table(const CostTableResult& result, const CostCode& code, Cost cost) {
    const double scale = scale_of(result, code);
    Table table = {{fmt::format("{}, {}: ns (published)", name_of(cost), name_of(code))}};
    for (const std::string& heading : vertex_headings(result.table)) table[0].push_back(heading);
    for (const CostRow& row : result.table.rows) {
        table.push_back({row.label});
        for (const int n : result.table.vertices) {
            const SamplerTiming* const timing = find(result, row, n, code);
            if (timing == nullptr) {
                table.back().push_back("");
                continue;
            }
            std::string text =
                fmt::format("{:.3g} ± {:.1g}", cost_of(*timing, cost), spread_of(*timing, cost));
            const auto published = published_cost(result.table, row, n, cost);
            if (published) text += fmt::format(" ({:.3g})", *published * scale);
            table.back().push_back(text);
        }
    }
    return table;
}

/// Published / each code.
Table comparison_table(const CostTableResult& result) {
    std::string codes;
    for (const CostCode& code : result.codes) codes += " / " + name_of(code);
    Table table = {{"ratio: published" + codes}};
    for (const std::string& heading : vertex_headings(result.table)) table[0].push_back(heading);
    for (const CostComparison& pair : result.table.comparisons)
        for (const Cost cost : kCosts) {
            table.push_back({fmt::format("{} over {}, {}", pair.row, pair.other, name_of(cost))});
            for (const int n : result.table.vertices) {
                std::string text = text_of(published_ratio(result.table, pair, n, cost), 2);
                for (const CostCode& code : result.codes)
                    text += " / " + text_of(measured_ratio(result, pair, n, cost, code), 2);
                table.back().push_back(text);
            }
        }
    return table;
}

/// A ratio that the text states, with the usual number of vertices.
double stated_ratio(const CostTableResult& result, const CostRatio& stated, const CostCode& code) {
    return measured_ratio(result, {stated.row, stated.other}, result.table.usual_vertices, stated.cost, code)
        .value();
}

double published_of(const CostRatio& stated) {
    const auto published = published_value(stated.item, stated.quantity);
    if (!published) throw std::logic_error("nobody published " + stated.item + ", " + stated.quantity);
    return *published;
}

Table ratio_table(const CostTableResult& result) {
    Table table = {{"ratio that the text states", "over", "quantity", "published"}};
    for (const CostCode& code : result.codes) table[0].push_back(name_of(code));
    for (const CostRatio& stated : result.table.ratios) {
        table.push_back({fmt::format("{}, {}", stated.row, name_of(stated.cost)), stated.other,
                         stated.quantity, fmt::format("{:.2g}", published_of(stated))});
        for (const CostCode& code : result.codes)
            table.back().push_back(fmt::format("{:.2f}", stated_ratio(result, stated, code)));
    }
    return table;
}

/// What costs at least twice as much in the papers, with any number of vertices, costs more here with each number for which
/// the papers print times, as scalars and in packs.
std::vector<ExpectationResult> check_ratios(const CostTableResult& result) {
    std::vector<ExpectationResult> results;
    for (const CostComparison& pair : result.table.comparisons)
        for (const Cost cost : kCosts)
            for (const CostCode& code : result.codes) {
                double largest = 0, least = INFINITY;
                for (const int n : result.table.vertices) {
                    const auto published = published_ratio(result.table, pair, n, cost);
                    const auto measured = measured_ratio(result, pair, n, cost, code);
                    if (!published || !measured) continue;
                    largest = std::max(largest, *published);
                    least = std::min(least, *measured);
                }
                if (largest < 2) continue;
                results.push_back(
                    checked(fmt::format("{} costs more than {} ({}, {}), at least {:.2f} times as much",
                                        pair.row, pair.other, name_of(cost), name_of(code), least),
                            least > 1));
            }
    return results;
}

Results numbers_of(const CostTableResult& result) {
    ResultTable costs = {"costs",
                         {{"row"},
                          {"technique"},
                          {"lights"},
                          {"vertices"},
                          {"code"},
                          {"prepare_ns", "ns"},
                          {"prepare_spread_ns", "ns"},
                          {"once_ns", "ns"},
                          {"once_spread_ns", "ns"},
                          {"sample_ns", "ns"},
                          {"sample_spread_ns", "ns"},
                          {"published_lights_ms", "ms"},
                          {"published_samples_ms", "ms"},
                          {"published_lights_ns", "ns"},
                          {"published_samples_ns", "ns"}}};
    ResultTable comparisons = {
        "comparisons", {{"row"}, {"other"}, {"column"}, {"vertices"}, {"code"}, {"published"}, {"measured"}}};
    ResultTable ratios = {"ratios", {{"item"}, {"quantity"}, {"code"}, {"published"}, {"measured"}}};
    const CostTable& table = result.table;
    for (const CostCode& code : result.codes) {
        const double scale = scale_of(result, code);
        const auto scaled = [&](std::optional<double> published) {
            if (published) *published *= scale;
            return cell_of(published);
        };
        for (const CostRow& row : table.rows)
            for (const int n : table.vertices) {
                const SamplerTiming* const t = find(result, row, n, code);
                if (t == nullptr) continue;
                const auto lights = published_cost(table, row, n, Cost::lights);
                const auto samples = published_cost(table, row, n, Cost::samples);
                costs.rows.push_back({row.label, row.technique, row.lights, std::int64_t{n}, name_of(code),
                                      *t->prepare_ns, *t->prepare_spread_ns, *t->once_ns, *t->once_spread_ns,
                                      *t->sample_ns, *t->sample_spread_ns, cell_of(lights), cell_of(samples),
                                      scaled(lights), scaled(samples)});
            }
        for (const CostComparison& pair : table.comparisons)
            for (const Cost cost : kCosts)
                for (const int n : table.vertices) {
                    const auto measured = measured_ratio(result, pair, n, cost, code);
                    if (!measured) continue;
                    comparisons.rows.push_back({pair.row, pair.other, name_of(cost), std::int64_t{n},
                                                name_of(code), cell_of(published_ratio(table, pair, n, cost)),
                                                *measured});
                }
        for (const CostRatio& stated : table.ratios)
            ratios.rows.push_back({stated.item, stated.quantity, name_of(code), published_of(stated),
                                   stated_ratio(result, stated, code)});
    }
    return {table.name,
            {{"repetitions", table.repetitions}, {"isa", result.codes.back().isa}},
            {std::move(costs), std::move(comparisons), std::move(ratios)}};
}

template <class Value>
void add_once(std::vector<Value>& values, const Value& value) {
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

} // namespace

const std::vector<CostTable>& all_cost_tables() {
    static const std::vector<CostTable> tables = {polygon_costs(), line_costs()};
    return tables;
}

std::vector<CostCode> cost_codes() {
    const base::Isa best = base::choose_isa();
    const base::Isa first = std::min(best, base::Isa::avx2);
    const auto packs = [](base::Isa isa) {
        return CostCode{name_of_code(base::lane_count(isa)), std::string(base::name_of(isa))};
    };
    std::vector<CostCode> codes = {{name_of_code(1), packs(first).isa}, packs(first)};
    if (best != first) codes.push_back(packs(best));
    return codes;
}

CostTable quick(CostTable table) {
    table.repetitions = 21;
    return table;
}

CostTableResult run_cost_table(const CostTable& table, const RunSettings& /*one thread, no scene*/,
                               const ProgressText& progress) {
    progress(fmt::format("{} interleaved repetitions", table.repetitions));
    SamplerTimingSettings settings;
    settings.repetitions = table.repetitions;
    for (const CostRow& row : table.rows) {
        add_once(settings.techniques, row.technique);
        for (const int n : table.vertices) add_once(settings.configurations, configuration_of(row, n));
    }
    CostTableResult result = {table, cost_codes(), {}};
    for (const CostCode& code : result.codes) {
        if (code.isa == settings.isa) continue; // scalars and packs are measured together
        settings.isa = code.isa;
        const std::vector<SamplerTiming> rows = time_samplers(settings);
        result.rows.insert(result.rows.end(), rows.begin(), rows.end());
    }
    return result;
}

Report report_of(const CostTableResult& result) {
    Report report;
    report.setting = fmt::format("Medians of {} interleaved repetitions ± half the interquartile range, with "
                                 "new lights in each, on one thread, without a baseline; packs: per lane. "
                                 "The papers measure shaders: a graphics processor runs as packs do. In "
                                 "brackets, published milliseconds for a frame, all multiplied by one "
                                 "number, such that they equal ours in the geometric mean.",
                                 result.table.repetitions);
    report.tables = {comparison_table(result), ratio_table(result)};
    for (const CostCode& code : result.codes)
        for (const Cost cost : kCosts) report.tables.push_back(cost_table(result, code, cost));
    report.expectations = check_ratios(result);
    const CostCode& packs = packs_of(result);
    const double scale = scale_of(result, packs);
    for (const CostRow& row : result.table.rows)
        for (const int n : result.table.vertices)
            for (const Cost cost : kCosts)
                if (published_cost(result.table, row, n, cost))
                    report.measured.push_back({result.table.item, quantity_of(row, n, cost),
                                               *measured_cost(result, row, n, cost, packs) / scale});
    for (const CostRatio& stated : result.table.ratios)
        report.measured.push_back({stated.item, stated.quantity, stated_ratio(result, stated, packs)});
    report.numbers = numbers_of(result);
    return report;
}

} // namespace nusselt::lab
