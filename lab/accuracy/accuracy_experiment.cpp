#include "lab/accuracy/accuracy_experiment.h"

#include "lab/accuracy/accuracy_json.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using proof::AccuracyRow;

/// A method of the tables.
struct Method {
    const char* label;
    const char* technique;
    const char* method;
};

constexpr Method kPolygonMethods[] = {
    {"solid angle, Arvo", "PolygonSolidAngleArvo", "published"},
    {"solid angle, formulas of Peters", "PolygonSolidAngle", "plain"},
    {"solid angle, ours", "PolygonSolidAngle", "ours"},
    {"projected solid angle, Arvo", "PolygonProjectedSolidAngleArvo", "published"},
    {"projected solid angle, bisection", "PolygonProjectedSolidAngleBisection", "published"},
    {"projected solid angle, formulas of Peters", "PolygonProjectedSolidAngle", "plain"},
    {"projected solid angle, no step", "PolygonProjectedSolidAngleBiased", "ours"},
    {"projected solid angle, ours", "PolygonProjectedSolidAngle", "ours"},
};
constexpr const char* kPolygonClasses[] = {"decentral", "central", "crossing the horizon",
                                           "square of 1 cm at 40 m", "square of 1 mm at 40 m"};

constexpr Method kLineMethods[] = {
    {"solid angle, formulas of Peters", "LineSolidAngle", "plain"},
    {"solid angle, ours", "LineSolidAngle", "ours"},
    {"projected solid angle, formulas of Peters", "LineProjectedSolidAngle", "plain"},
    {"projected solid angle, ours", "LineProjectedSolidAngle", "ours"},
    {"thin rectangle, Ureña et al.", "LineRectangleUrena", "published"},
};
constexpr const char* kLineClasses[] = {"ordinary", "crossing the horizon", "1 cm at 40 m", "1 mm at 40 m",
                                        "1e-3 of the length beside it"};

const AccuracyRow& row_of(const AccuracyStudyResult& result, const std::string& technique,
                          const std::string& method, const std::string& lights) {
    const std::vector<AccuracyRow>& rows = result.table.rows;
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const AccuracyRow& r) {
        return r.technique == technique && r.method == method && r.lights == lights && r.scalar == "float";
    });
    if (found == rows.end())
        throw std::logic_error(fmt::format("nobody measures {}, {}, {}", technique, method, lights));
    return *found;
}

template <std::size_t Methods, std::size_t Classes>
Table table_of(const AccuracyStudyResult& result, const Method (&methods)[Methods],
               const char* const (&classes)[Classes]) {
    Table table = {{"backward error in float: 99 % / largest, invalid results"}};
    table[0].insert(table[0].end(), std::begin(classes), std::end(classes));
    for (const Method& m : methods) {
        table.push_back({m.label});
        for (const char* const lights : classes) {
            const AccuracyRow& row = row_of(result, m.technique, m.method, lights);
            const std::int64_t invalid = row.nan + row.infinite + row.negative;
            table.back().push_back(fmt::format("{:.1e} / {:.1e}{}", row.backward.p99, row.backward.max,
                                               invalid > 0 ? fmt::format(", {}", invalid) : ""));
        }
    }
    return table;
}

std::vector<ExpectationResult> check(const AccuracyStudyResult& result) {
    const auto error = [&](const char* technique, const char* method, const char* lights) {
        return row_of(result, technique, method, lights).backward;
    };
    double arvo = 0;
    for (const char* const lights : {"decentral", "central", "crossing the horizon"})
        arvo = std::max(arvo, error("PolygonProjectedSolidAngleArvo", "published", lights).max);
    const double bisection = error("PolygonProjectedSolidAngleBisection", "published", "decentral").p99;
    const double no_step = error("PolygonProjectedSolidAngleBiased", "ours", "decentral").p99;
    const double arvo_small = error("PolygonSolidAngleArvo", "published", "square of 1 cm at 40 m").p99;
    const double small = error("PolygonProjectedSolidAngle", "ours", "square of 1 cm at 40 m").p99;
    const double floor = error("PolygonProjectedSolidAngle", "floor", "square of 1 cm at 40 m").p99;
    std::int64_t invalid = 0;
    for (const AccuracyRow& row : result.table.rows)
        if (row.method.rfind("ours", 0) == 0) invalid += row.nan + row.infinite + row.negative;
    return {
        checked(fmt::format("three steps of Newton's method do not always converge: largest error {:.2g}, "
                            "above 0.01",
                            arvo),
                arvo > 0.01),
        checked(fmt::format("six bisections are about as accurate as no step: 99 % of the errors below "
                            "{:.2g} and {:.2g}",
                            bisection, no_step),
                bisection < 3 * no_step && no_step < 10 * bisection),
        checked(fmt::format("Arvo's solid angle sampling loses a light of 1 cm at 40 m: 99 % of the errors "
                            "below {:.2g} only",
                            arvo_small),
                arvo_small > 0.01),
        checked(fmt::format("projected solid angle sampling does not: below {:.2g}, where rounded directions "
                            "leave {:.2g}",
                            small, floor),
                small < 3 * floor),
        checked("none of our results is NaN, infinite or negative", invalid == 0)};
}

} // namespace

const std::vector<AccuracyStudy>& all_accuracy_studies() {
    static const std::vector<AccuracyStudy> studies = {
        {"accuracy", "Peters 2021, polygonal lights, Sec. 3.6 to 3.8, 5 and 6.2; linear lights, Sec. 3.4",
         "Errors in single precision on classes of random lights, published methods beside ours."}};
    return studies;
}

AccuracyStudy quick(AccuracyStudy study) {
    study.count /= 10;
    return study;
}

AccuracyStudyResult run_accuracy_study(const AccuracyStudy& study, const RunSettings& settings,
                                       const ProgressText& progress) {
    progress(fmt::format("{} lights of each class", study.count));
    AccuracyStudyResult result = {study, {}};
    tbb::task_arena(thread_count(settings)).execute([&] {
        result.table = measure_accuracy({study.count, {}});
    });
    return result;
}

Report report_of(const AccuracyStudyResult& result) {
    Report report;
    report.setting = fmt::format(
        "{} lights of each class, one sample of each; docs/accuracy.md describes the errors and has all "
        "techniques and classes.",
        result.study.count);
    report.tables = {table_of(result, kPolygonMethods, kPolygonClasses),
                     table_of(result, kLineMethods, kLineClasses)};
    report.expectations = check(result);
    report.measured = {
        {"polygons-sec-3.8-bisection", "backward error, order of magnitude",
         row_of(result, "PolygonProjectedSolidAngleBisection", "published", "decentral").backward.p99}};
    report.numbers = results_of(result.table);
    return report;
}

} // namespace nusselt::lab
