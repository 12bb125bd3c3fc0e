#include "lab/fuzzing/worst_case.h"

#include "lab/fuzzing/nelder_mead.h"
#include "proof/worst_case_lights.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>

namespace nusselt::lab {

namespace {

/// The climb starts at the worst of these random cases.
constexpr int kRandomCases = 64;
/// The papers use the same number.
constexpr int kIterations = 100;

/// The search space of one target in one precision.
/// \tparam Case SectorCase or LineCase.
template <template <class> class Case, int Iterations, class Real>
struct Space {
    using Light = Case<Real>;
    using Coordinates = Point<Real, Light::kDimension>;

    long double least_measure;

    static Box<Real, Light::kDimension> box() {
        Box<Real, Light::kDimension> box;
        box.low.fill(-proof::kReach);
        box.high.fill(proof::kReach);
        return box;
    }

    /// The objective: the backward error, or -infinity for lights that are too small.
    Real operator()(const Coordinates& coordinates) const {
        const Light light = Light::at(coordinates);
        const typename Light::template Technique<Iterations> technique(light.light());
        const bool allowed = technique.measure() > 0 && technique.measure() >= least_measure;
        return allowed ? light.error(technique) : -std::numeric_limits<Real>::infinity();
    }

    /// Climbs with simplices of decreasing size, because simplices tend to collapse before they reach the summit.
    Vertex<Real, Light::kDimension> climb(Coordinates start, std::initializer_list<double> sizes) const {
        Vertex<Real, Light::kDimension> best{start, 0};
        for (const double size : sizes)
            best = maximize(*this, box(), best.at, static_cast<Real>(size), kIterations);
        return best;
    }
};

// The published iteration diverges where circles meet close to the horizon. The paper does not say how its search kept away
// from there; with these restrictions, the worst cases are those of the paper.
template <class Real>
using PublishedSectors = proof::PublishedSectorCase<Real, 100>;
template <class Real>
using PublishedSteepSectors = proof::PublishedSectorCase<Real, 10'000>;

template <template <class> class Case, int Iterations>
WorstCaseTarget make_target(const char* name, const char* description, long double least_measure,
                            long double bound) {
    constexpr std::size_t kDimension = Case<double>::kDimension;
    const auto climb = [least_measure](std::uint64_t seed, std::uint64_t index) {
        const Space<Case, Iterations, double> space{least_measure};
        proof::RandomCoordinates random(seed, index);
        Vertex<double, kDimension> start{{}, -std::numeric_limits<double>::infinity()};
        for (int i = 0; i < kRandomCases; ++i) {
            Point<double, kDimension> p;
            for (double& x : p) x = random.hard();
            const double value = space(p);
            if (value > start.value) start = {p, value};
        }
        if (!(start.value >= 0)) return Summit();
        const auto summit = space.climb(start.at, {1, 0.3, 0.1});
        return Summit{{summit.at.begin(), summit.at.end()}, summit.value};
    };
    const auto refine = [least_measure](const Summit& summit) {
        const Space<Case, Iterations, long double> space{least_measure};
        Point<long double, kDimension> start;
        std::copy(summit.coordinates.begin(), summit.coordinates.end(), start.begin());
        const auto top = space.climb(start, {0.03, 0.003});
        const auto parameters = Case<long double>::at(top.at).parameters;
        return WorstCase{{parameters.begin(), parameters.end()}, top.value};
    };
    const auto error = [](const std::vector<long double>& parameters) {
        Case<long double> light;
        std::copy(parameters.begin(), parameters.end(), light.parameters.begin());
        return light.error(typename Case<long double>::template Technique<Iterations>(light.light()));
    };
    const auto& names = Case<double>::kNames;
    return {name, description, {names.begin(), names.end()}, bound, climb, refine, error};
}

} // namespace

const std::vector<WorstCaseTarget>& worst_case_targets() {
    // The bounds are those in the doc comments of the techniques, or the results of the search, rounded up. Those of the
    // published iterations are 5 % above the published worst cases.
    static const std::vector<WorstCaseTarget> targets = {
        make_target<proof::LineCase, 2>("lines", "line, 2 steps", 1e-7L, 9.3e-7L),
        make_target<proof::LineCase, 1>("lines-1", "line, 1 step", 1e-7L, 4.7e-4L),
        make_target<proof::SectorCase, 2>("polygons", "sector of at least 1e-2 sr, 2 steps", 1e-2L, 2e-5L),
        make_target<proof::SectorCase, 2>("small-polygons", "sector of at least 1e-7 sr, 2 steps", 1e-7L,
                                          7.3e-5L),
        make_target<proof::SectorCase, 0>("biased", "sector of at least 1e-2 sr, no step", 1e-2L, 0.28L),
        make_target<proof::PublishedLineCase, 2>("published-lines", "line, published iteration", 1e-7L,
                                                 1.66e-5L),
        make_target<PublishedSectors, 2>("published-polygons",
                                         "sector of at least 1e-2 sr, published iteration", 1e-2L, 1.89e-5L),
        make_target<PublishedSteepSectors, 2>(
            "published-small-polygons", "sector of at least 1e-7 sr, published iteration", 1e-7L, 6.93e-5L),
    };
    return targets;
}

const WorstCaseTarget& worst_case_target(const std::string& name) {
    for (const WorstCaseTarget& target : worst_case_targets())
        if (target.name == name) return target;
    throw std::invalid_argument("unknown search for the worst case of '" + name + "'");
}

void WorstCaseSearch::resume(std::uint64_t starts, const std::vector<long double>& parameters) {
    const std::size_t expected = target_->parameter_names.size();
    if (!parameters.empty() && parameters.size() != expected)
        throw std::invalid_argument(fmt::format("a case of '{}' has {} parameters, not {}", target_->name,
                                                expected, parameters.size()));
    starts_ = starts;
    worst_ = {parameters, parameters.empty() ? 0 : target_->error(parameters)};
}

void WorstCaseSearch::run(std::uint64_t more_starts) {
    std::vector<Summit> summits(more_starts);
    tbb::parallel_for(std::uint64_t(0), more_starts,
                      [&](std::uint64_t i) { summits[i] = target_->climb(seed_, starts_ + i); });
    // The order matters: the refinement depends on the worst case so far.
    for (const Summit& summit : summits) {
        if (summit.coordinates.empty() || summit.error <= worst_.error) continue;
        WorstCase refined = target_->refine(summit);
        if (refined.error > worst_.error) worst_ = std::move(refined);
    }
    starts_ += more_starts;
}

} // namespace nusselt::lab
