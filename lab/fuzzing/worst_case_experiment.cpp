#include "lab/fuzzing/worst_case_experiment.h"

#include "proof/worst_case_lights.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

namespace {

constexpr std::uint64_t kSeed = 1;
/// Starts between two lines of progress.
constexpr std::uint64_t kBlock = 5000;

/// A worst case that a paper states.
struct Published {
    const char* target;
    const char* item; ///< of published.json
    const char* quantity;
    double error;
};
constexpr Published kPublished[] = {
    {"published-lines", "lines-sec-3.4-worst-case", "largest backward error", 1.58e-5},
    {"published-polygons", "polygons-sec-3.6-worst-case", "largest backward error, sectors of at least 1e-2",
     1.8e-5},
    {"published-small-polygons", "polygons-sec-3.6-worst-case",
     "largest backward error, sectors of at least 1e-7", 6.6e-5},
    {"biased", "polygons-sec-3.6-no-step", "largest backward error", 0.27},
};
constexpr double kTolerance = 0.05;

const WorstCaseSearch& search_of(const WorstCaseStudyResult& result, const std::string& target) {
    const auto found = std::find_if(result.searches.begin(), result.searches.end(),
                                    [&](const WorstCaseSearch& s) { return s.target().name == target; });
    if (found == result.searches.end()) throw std::logic_error("no search for the worst case of " + target);
    return *found;
}

double error_of(const WorstCaseStudyResult& result, const std::string& target) {
    return static_cast<double>(search_of(result, target).worst().error);
}

/// Quantiles over random cases whose measure is at least 1e-2.
template <template <class> class Case, int Steps>
TypicalErrors typical_errors(const char* lights, int count) {
    using Real = long double;
    proof::RandomCoordinates random(kSeed, 0);
    std::vector<Real> errors;
    while (errors.size() < static_cast<std::size_t>(count)) {
        std::array<Real, Case<Real>::kDimension> coordinates;
        for (Real& x : coordinates) x = random.uniform();
        const auto light = Case<Real>::at(coordinates);
        const typename Case<Real>::template Technique<Steps> technique(light.light());
        if (technique.measure() < 1e-2L) continue;
        const Real error = light.error(technique);
        if (error >= 0) errors.push_back(error);
    }
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
        return static_cast<double>(
            errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))]);
    };
    return {lights, at(0.5), at(0.99), at(1)};
}

template <class Real>
using PublishedSectors = proof::PublishedSectorCase<Real, 0>;

/// Both circles meet at the horizon where the sector ends, next to the random number.
constexpr std::array<long double, 6> kDivergent = {1.57154150239537L,     57.6251042085971L,
                                                   3.82576234758848e-08L, 33.1832414848027L,
                                                   1.21032767934941e-09L, 0.999971579807814L};

template <class Technique>
long double divergent_error() {
    const proof::SectorCase<long double> sector{kDivergent};
    const PolygonProjectedSolidAngle<long double, 4> exact(sector.light());
    const Vec2<long double> u{kDivergent[5], 0.5L};
    return backward_error(exact, u, Technique(sector.light()).sample(u).wi);
}

Table worst_table(const WorstCaseStudyResult& result) {
    Table table = {{"worst case", "lights", "starts", "backward error", "published", "ratio"}};
    for (const WorstCaseSearch& search : result.searches) {
        const auto error = static_cast<double>(search.worst().error);
        table.push_back({search.target().name, search.target().description,
                         fmt::format("{}", search.starts()), fmt::format("{:.4g}", error)});
        for (const Published& p : kPublished)
            if (search.target().name == p.target)
                table.back().insert(table.back().end(),
                                    {fmt::format("{:.3g}", p.error), fmt::format("{:.3f}", error / p.error)});
    }
    table.push_back({"divergence of the published iteration", "circles that meet at the horizon", "",
                     fmt::format("{:.4g}", static_cast<double>(result.divergent_published))});
    table.push_back({"the same sector, our iteration", "", "",
                     fmt::format("{:.4g}", static_cast<double>(result.divergent_ours))});
    return table;
}

Table typical_table(const WorstCaseStudyResult& result) {
    Table table = {{"random cases of at least 1e-2", "median", "99 %", "largest"}};
    for (const TypicalErrors& t : result.typical)
        table.push_back({t.lights, fmt::format("{:.2g}", t.median), fmt::format("{:.2g}", t.p99),
                         fmt::format("{:.2g}", t.largest)});
    return table;
}

Table convergence_table(const char* lights, const std::vector<ConvergenceRow>& rows) {
    Table table = {{fmt::format("convergence, {}: steps", lights), "median error", "order", "cases"}};
    for (const ConvergenceRow& row : rows)
        table.push_back({fmt::format("{}", row.steps), fmt::format("{:.1e}", row.median_error),
                         row.order_cases > 0 ? fmt::format("{:.2f}", row.order) : "-",
                         fmt::format("{}", row.order_cases)});
    return table;
}

/// The order after the second step, from which the constant factor cancels.
const ConvergenceRow& order_row(const std::vector<ConvergenceRow>& rows) { return rows.at(2); }

std::vector<ExpectationResult> check(const WorstCaseStudyResult& result) {
    std::vector<ExpectationResult> all;
    for (const Published& p : kPublished) {
        const double ratio = error_of(result, p.target) / p.error;
        all.push_back(checked(fmt::format("the worst case of {} is within {:g} % of the published {:.3g}",
                                          p.target, 100 * kTolerance, p.error),
                              std::fabs(ratio - 1) <= kTolerance));
    }
    for (const WorstCaseSearch& search : result.searches) {
        if (search.target().name.rfind("published", 0) == 0) continue; // see above
        all.push_back(checked(fmt::format("the worst case of {} is at most {:.3g}", search.target().name,
                                          static_cast<double>(search.target().bound)),
                              search.worst().error <= search.target().bound));
    }
    all.push_back(checked("our iteration for lines has a smaller worst case than the published one",
                          error_of(result, "lines") < error_of(result, "published-lines")));
    all.push_back(checked("the published iteration diverges where circles meet at the horizon (error above "
                          "0.5), and ours does not (below 1e-4)",
                          result.divergent_published > 0.5L && result.divergent_ours < 1e-4L));
    const ConvergenceRow& sectors = order_row(result.sector_convergence);
    all.push_back(
        checked(fmt::format("the iteration for sectors converges cubically: order {:.2f} in {} cases",
                            sectors.order, sectors.order_cases),
                sectors.order_cases >= 30 && std::fabs(sectors.order - 3) < 0.3));
    return all;
}

Results numbers_of(const WorstCaseStudyResult& result) {
    ResultTable worst = {"worst", {{"target"}, {"lights"}, {"starts"}, {"error"}, {"bound"}}};
    for (const WorstCaseSearch& s : result.searches)
        worst.rows.push_back({s.target().name, s.target().description, s.starts(),
                              static_cast<double>(s.worst().error), static_cast<double>(s.target().bound)});
    ResultTable typical = {"typical", {{"lights"}, {"median"}, {"p99"}, {"largest"}}};
    for (const TypicalErrors& t : result.typical)
        typical.rows.push_back({t.lights, t.median, t.p99, t.largest});
    ResultTable orders = {"convergence", {{"lights"}, {"steps"}, {"median_error"}, {"order"}, {"cases"}}};
    const auto append = [&](const char* lights, const std::vector<ConvergenceRow>& rows) {
        for (const ConvergenceRow& row : rows)
            orders.rows.push_back({lights, row.steps, row.median_error,
                                   row.order_cases > 0 ? Cell(row.order) : Cell(nullptr), row.order_cases});
    };
    append("lines", result.line_convergence);
    append("sectors", result.sector_convergence);
    return {result.study.name,
            {{"starts", result.study.starts}, {"cases", result.study.cases}, {"seed", kSeed}},
            {std::move(worst), std::move(typical), std::move(orders)}};
}

} // namespace

const std::vector<WorstCaseStudy>& all_worst_case_studies() {
    static const std::vector<WorstCaseStudy> studies = {
        {"worst-cases", "Peters 2021, polygonal lights, Sec. 3.5 and 3.6; linear lights, Sec. 3.4",
         "The largest backward errors after two steps that searches find in long double, and the order of "
         "convergence."}};
    return studies;
}

WorstCaseStudy quick(WorstCaseStudy study) {
    study.starts = 400;
    study.cases = 20'000;
    return study;
}

WorstCaseStudyResult run_worst_case_study(const WorstCaseStudy& study, const RunSettings& settings,
                                          const ProgressText& progress) {
    WorstCaseStudyResult result;
    result.study = study;
    tbb::task_arena arena(thread_count(settings));
    for (const WorstCaseTarget& target : worst_case_targets()) {
        WorstCaseSearch& search = result.searches.emplace_back(target, kSeed);
        while (search.starts() < study.starts) {
            progress(fmt::format("{}, {} of {} starts", target.name, search.starts(), study.starts));
            arena.execute([&] { search.run(std::min(kBlock, study.starts - search.starts())); });
        }
    }
    progress("random cases");
    result.typical = {typical_errors<proof::SectorCase, 0>("sectors, no step", study.cases),
                      typical_errors<PublishedSectors, 2>("sectors, published iteration", study.cases),
                      typical_errors<proof::SectorCase, 2>("sectors, our iteration", study.cases),
                      typical_errors<proof::PublishedLineCase, 2>("lines, published iteration", study.cases),
                      typical_errors<proof::LineCase, 2>("lines, our iteration", study.cases)};
    const int errors = std::min(study.cases, 20'000);
    result.line_convergence = convergence_of(line_errors(errors, kSeed));
    result.sector_convergence = convergence_of(sector_errors(errors, kSeed));
    using Real = long double;
    result.divergent_published = divergent_error<PolygonProjectedSolidAnglePeters<Real, 4>>();
    result.divergent_ours = divergent_error<PolygonProjectedSolidAngle<Real, 4, 2>>();
    return result;
}

Report report_of(const WorstCaseStudyResult& result) {
    Report report;
    report.setting =
        "Backward errors are changes of the random number that explain a sample. The distribution of the "
        "papers' random cases is unknown, and percentiles depend on it: they are not those of the papers.";
    report.tables = {worst_table(result), typical_table(result),
                     convergence_table("sectors", result.sector_convergence),
                     convergence_table("lines", result.line_convergence)};
    report.expectations = check(result);
    for (const Published& p : kPublished)
        report.measured.push_back({p.item, p.quantity, error_of(result, p.target)});
    report.measured.push_back(
        {"polygons-sec-3.6-no-step", "99th percentile of the backward error", result.typical[0].p99});
    report.measured.push_back(
        {"polygons-sec-3.6-typical-error", "99th percentile of the backward error", result.typical[1].p99});
    report.measured.push_back({"polygons-sec-3.5-cubic-convergence", "order of convergence",
                               order_row(result.sector_convergence).order});
    report.numbers = numbers_of(result);
    return report;
}

} // namespace nusselt::lab
