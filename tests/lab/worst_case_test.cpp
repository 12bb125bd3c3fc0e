#include "lab/fuzzing/worst_case.h"

#include "lab/fuzzing/convergence.h"
#include "proof/worst_case_lights.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

using proof::kReach;
using proof::LineCase;
using proof::RandomCoordinates;
using proof::share_of;

namespace {

using Real = long double;

WorstCaseSearch search_of(const char* target, std::uint64_t starts) {
    WorstCaseSearch search(worst_case_target(target), 1);
    search.run(starts);
    return search;
}

/// Results of long searches; see docs/performance.md.
struct Known {
    const char* target;
    Real error;
};
constexpr Known kKnown[] = {{"lines", 9.287e-7L},
                            {"lines-1", 4.657e-4L},
                            {"polygons", 1.97e-5L},
                            {"small-polygons", 7.289e-5L},
                            {"biased", 0.27176L},
                            {"published-lines", 1.5761e-5L},
                            {"published-polygons", 1.8117e-5L},
                            {"published-small-polygons", 6.734e-5L}};

TEST(WorstCase, ShortSearchesComeCloseToTheKnownMaximaAndStayBelowTheBounds) {
    for (const Known& known : kKnown) {
        const WorstCaseSearch search = search_of(known.target, 200);
        EXPECT_GT(search.worst().error, 0.9L * known.error) << known.target;
        EXPECT_LE(search.worst().error, search.target().bound) << known.target;
        // Bounds are no more generous than they need to be.
        EXPECT_LE(search.target().bound, 1.1L * known.error) << known.target;
        EXPECT_EQ(search.worst().error, search.target().error(search.worst().parameters)) << known.target;
    }
}

TEST(WorstCase, DoesNotDependOnThreadsNorOnTheSplit) {
    const auto& target = worst_case_target("lines");
    WorstCaseSearch at_once(target, 7);
    tbb::task_arena(1).execute([&] { at_once.run(60); });
    WorstCaseSearch in_parts(target, 7);
    tbb::task_arena(2).execute([&] {
        in_parts.run(1);
        in_parts.run(20);
    });
    WorstCaseSearch resumed(target, 7);
    resumed.resume(in_parts.starts(), in_parts.worst().parameters);
    EXPECT_EQ(resumed.worst().error, in_parts.worst().error);
    resumed.run(39);
    EXPECT_EQ(resumed.starts(), at_once.starts());
    EXPECT_EQ(resumed.worst().error, at_once.worst().error);
    EXPECT_EQ(resumed.worst().parameters, at_once.worst().parameters);

    WorstCaseSearch other_seed(target, 8);
    other_seed.run(60);
    EXPECT_NE(other_seed.worst().parameters, at_once.worst().parameters);
}

TEST(WorstCase, RejectsUnknownTargetsAndCasesOfOthers) {
    EXPECT_THROW(worst_case_target("spheres"), std::invalid_argument);
    WorstCaseSearch search(worst_case_target("lines"), 1);
    EXPECT_THROW(search.resume(1, {0, 1, 2}), std::invalid_argument);
}

TEST(WorstCase, CoordinatesReachBothEndsOfTheRange) {
    EXPECT_EQ(share_of<Real>(-kReach), 0);
    EXPECT_EQ(share_of<Real>(0), 0.5L);
    EXPECT_LT(share_of<Real>(kReach), 1);
    EXPECT_GT(share_of<Real>(kReach), 1 - 1e-10L);
}

// Ten times the largest deviation for four seeds; it comes from the next term of the expansion of the error.
constexpr double kOrderTolerance = 0.01;

/// Most lines start so close to the result that one step reaches rounding. Those with an error left after two steps took
/// a large first step, for which the next term of the expansion is half of the first one. Twice the deviation that
/// docs/performance.md has, 0.05.
constexpr double kOrderToleranceOfLines = 0.1;

void expect_cubic(const std::vector<ErrorSequence>& errors, double tolerance) {
    const std::vector<ConvergenceRow> rows = convergence_of(errors);
    EXPECT_GE(rows[2].order_cases, 30u); // also where long double is double
    EXPECT_NEAR(rows[2].order, 3, tolerance);
    // Errors of random lights start below 0.1 and are below 1e-5 after one step and at rounding after two.
    EXPECT_LT(rows[0].median_error, 0.1);
    EXPECT_LT(rows[1].median_error, 1e-5);
    EXPECT_LT(rows[2].median_error, 100 * std::numeric_limits<Real>::epsilon());
    EXPECT_LT(rows[4].median_error, 100 * std::numeric_limits<Real>::epsilon());
}

TEST(Convergence, LinesHaveOrderThree) { expect_cubic(line_errors(60'000, 1), kOrderToleranceOfLines); }

TEST(Convergence, SectorsHaveOrderThree) { expect_cubic(sector_errors(500, 1), kOrderTolerance); }

/// The errors of the technique with Newton's method instead of Laguerre's, from the integral of the paper.
ErrorSequence newton_errors(const LineCase<Real>& light) {
    const auto& [tilt, begin, end, u] = light.parameters;
    const Real n_s = std::sin(tilt);
    const Real n_t = std::cos(tilt);
    const auto integral = [&](Real a) {
        return n_s * std::sin(a) * std::sin(a) + n_t * (std::sin(a) * std::cos(a) + a);
    };
    const auto height = [&](Real a) { return n_s * std::sin(a) + n_t * std::cos(a); };
    const Real whole = integral(end) - integral(begin);
    Real alpha = std::asin(std::sin(begin) + u * (std::sin(end) - std::sin(begin)));
    ErrorSequence errors;
    for (Real& error : errors) {
        const Real reached = (integral(alpha) - integral(begin)) / whole;
        error = std::fabs(reached - u);
        alpha -= (reached - u) * whole / (2 * height(alpha) * std::cos(alpha));
        alpha = std::clamp(alpha, begin, end);
    }
    return errors;
}

TEST(Convergence, NewtonsMethodIsFoundToHaveOrderTwo) {
    RandomCoordinates random(1, 0);
    std::vector<ErrorSequence> errors;
    while (errors.size() < 500) {
        std::array<Real, 4> coordinates;
        for (Real& x : coordinates) x = random.uniform();
        errors.push_back(newton_errors(LineCase<Real>::at(coordinates)));
    }
    const std::vector<ConvergenceRow> rows = convergence_of(errors);
    for (const int step : {2, 3}) {
        EXPECT_GT(rows[static_cast<std::size_t>(step)].order_cases, 50u);
        EXPECT_NEAR(rows[static_cast<std::size_t>(step)].order, 2, kOrderTolerance);
    }
}

TEST(Convergence, RoundingAndLargeErrorsTellNothing) {
    const std::vector<ConvergenceRow> rows =
        convergence_of({{1e-2L, 0, 1e-19L, 0, 0}, {0.5L, 0.4L, 0.3L, 0.2L, 0.1L}});
    for (const ConvergenceRow& row : rows) {
        EXPECT_EQ(row.digit_cases, 0u);
        EXPECT_EQ(row.order_cases, 0u);
    }
}

TEST(Convergence, RecoversAnOrderWithAConstantFactor) {
    std::vector<ErrorSequence> errors(1);
    Real e = 1e-2L;
    for (Real& error : errors[0]) {
        error = e;
        e = 2 * std::pow(e, 1.5L);
    }
    for (const ConvergenceRow& row : convergence_of(errors)) {
        if (row.steps < 2) continue;
        EXPECT_EQ(row.order_cases, 1u);
        EXPECT_NEAR(row.order, 1.5, 1e-9);
    }
}

} // namespace

} // namespace nusselt::lab
