/// Tests that estimates of direct light from few samples have the mean that quadrature predicts, for all lights,
/// surfaces, techniques and heuristics, and that estimators with a mistake do not.

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hypothesis.h"
#include "reflected_light.h"
#include "replicates.h"

namespace nusselt_test {
namespace {

using nusselt::BalanceHeuristic;
using nusselt::DirectLight;
using nusselt::DirectLightSample;
using nusselt::MisEstimate;
using nusselt::MisSample;
using nusselt::MisTechniques;
using nusselt::PowerHeuristic;
using nusselt::SeparateComponents;
using nusselt::WeightedBalanceHeuristic;
using ClampedOptimal = nusselt::ClampedOptimalHeuristic<double>;
using Optimal = nusselt::OptimalHeuristic<double>;

/// Relative slack of a mean. A shadow or another edge on a line puts a step into a one-dimensional net, and the rare
/// samples next to it cause an error that the replicates seldom show.
constexpr double kSlack = 5e-4;

/// The number of samples of each technique for a light.
struct Counts {
    int diffuse, specular;
};

/// The contribution of a sample to the reflected light.
double share(const DirectLightSample<double>& s, Visibility visibility) {
    return visibility(s.wi) * sum_of_channels(s.shadowed) + sum_of_channels(s.constant);
}

double p_value(const std::vector<double>& means, double truth) {
    return student_t_test(means, truth, kSlack * truth + 3 * static_cast<double>(kQuadratureTolerance));
}

template <class Strategies, class Light>
using Estimator = DirectLight<double, Light, nusselt::Frostbite<double>, Strategies>;

/// p-value of one combination of light and surface.
template <class Strategies, class Light, class Heuristic>
double p_value_of(const ReflectedLight<Light>& reflected, const Heuristic& heuristic,
                  Counts counts = {1, 1}) {
    const Estimator<Strategies, Light> estimator(reflected.light, reflected.surface, counts.diffuse,
                                                 counts.specular);
    const auto means = means_of([&](const auto& next) {
        double sum = 0;
        for (int i = 0; i < counts.diffuse; ++i)
            sum += share(estimator.sample_diffuse(heuristic, next()), reflected.visibility);
        for (int i = 0; i < counts.specular; ++i)
            sum += share(estimator.sample_specular(heuristic, next()), reflected.visibility);
        return sum;
    });
    return p_value(means, reflected.truth);
}

/// Passes if the p-values do not reject the hypothesis that estimates are unbiased.
template <class Light>
testing::AssertionResult unbiased(const std::vector<double>& p_values,
                                  const std::vector<ReflectedLight<Light>>& list) {
    if (!reject(p_values)) return testing::AssertionSuccess();
    const auto worst = std::min_element(p_values.begin(), p_values.end());
    return testing::AssertionFailure()
           << "p = " << *worst << ": " << list[static_cast<std::size_t>(worst - p_values.begin())].name;
}

template <class Strategies, class Light, class Heuristic>
testing::AssertionResult unbiased_with(const Heuristic& heuristic,
                                       const std::vector<ReflectedLight<Light>>& list, Counts counts) {
    std::vector<double> p_values;
    for (const auto& reflected : list)
        p_values.push_back(p_value_of<Strategies>(reflected, heuristic, counts));
    return unbiased(p_values, list);
}

template <class Strategies, class Light>
void expect_unbiased_by_densities(const std::vector<ReflectedLight<Light>>& list) {
    EXPECT_TRUE((unbiased_with<Strategies>(BalanceHeuristic(), list, {1, 1})));
    EXPECT_TRUE((unbiased_with<Strategies>(PowerHeuristic(), list, {2, 1})));
    EXPECT_TRUE((unbiased_with<Strategies>(Optimal{0.5}, list, {1, 1})));
    EXPECT_TRUE((unbiased_with<Strategies>(Optimal{1}, list, {1, 2})));
}

template <class Strategies, class Light>
void expect_unbiased_by_components(const std::vector<ReflectedLight<Light>>& list) {
    EXPECT_TRUE((unbiased_with<Strategies>(WeightedBalanceHeuristic(), list, {1, 1})));
    EXPECT_TRUE((unbiased_with<Strategies>(WeightedBalanceHeuristic(), list, {1, 3})));
    EXPECT_TRUE((unbiased_with<Strategies>(ClampedOptimal{0.5}, list, {1, 1})));
    EXPECT_TRUE((unbiased_with<Strategies>(ClampedOptimal{0.5}, list, {3, 1})));
    EXPECT_TRUE((unbiased_with<Strategies>(SeparateComponents(), list, {1, 1})));

    std::vector<double> one_sample;
    for (const auto& reflected : list) {
        const Estimator<Strategies, Light> estimator(reflected.light, reflected.surface);
        one_sample.push_back(p_value(means_of([&](const auto& next) {
                                         return share(estimator.sample_one(next()), reflected.visibility);
                                     }),
                                     reflected.truth));
    }
    EXPECT_TRUE(unbiased(one_sample, list)) << "one sample";
}

const std::vector<double> kAllRoughnesses = {0.05, 0.3, 1};

TEST(DirectLightOfPolygons, IsUnbiased) {
    const auto list = reflected_polygons(surfaces(kAllRoughnesses));
    expect_unbiased_by_densities<nusselt::ProjectedSolidAngleAndLtc>(list);
    expect_unbiased_by_components<nusselt::ProjectedSolidAngleAndLtc>(list);
}

TEST(DirectLightOfLines, IsUnbiased) {
    const auto list = reflected_lines(surfaces(kAllRoughnesses));
    expect_unbiased_by_densities<nusselt::ProjectedSolidAngleAndLtc>(list);
    expect_unbiased_by_components<nusselt::ProjectedSolidAngleAndLtc>(list);
}

TEST(DirectLightOfCylinders, IsUnbiased) {
    const auto list = reflected_cylinders(surfaces(kAllRoughnesses));
    expect_unbiased_by_densities<nusselt::ProjectedSolidAngleAndLtc>(list);
    expect_unbiased_by_components<nusselt::ProjectedSolidAngleAndLtc>(list);
}

template <class Strategies>
class DirectLightByBrdf : public testing::Test {};
using Pairs = testing::Types<nusselt::ProjectedSolidAngleAndBrdf<nusselt::GgxVisibleNormals>,
                             nusselt::SolidAngleAndBrdf<nusselt::GgxVisibleNormals>,
                             nusselt::SolidAngleAndBrdf<nusselt::GgxBoundedVisibleNormals>>;
TYPED_TEST_SUITE(DirectLightByBrdf, Pairs);

TYPED_TEST(DirectLightByBrdf, IsUnbiased) {
    expect_unbiased_by_densities<TypeParam>(reflected_polygons(surfaces(kAllRoughnesses)));
    // These heuristics leave narrow peaks to the other technique and distant tails to this one. On smoother surfaces,
    // either would be hit too rarely for a test.
    expect_unbiased_by_components<TypeParam>(reflected_polygons(surfaces({0.5, 1})));
}

/// Passes wrong facts about the techniques and samples to a heuristic.
template <class Heuristic, class Change>
struct Mutant {
    Heuristic heuristic;
    Change change;

    template <int J>
    MisEstimate<double> estimate(MisTechniques<double, 2> techniques, MisSample<double, 2> sample) const {
        change(techniques, sample);
        return heuristic.template estimate<J>(techniques, sample);
    }
};
template <class Heuristic, class Change>
Mutant(Heuristic, Change) -> Mutant<Heuristic, Change>;

/// A heuristic without a technique for the diffuse component.
struct SpecularTechniqueAlone {
    template <int J>
    MisEstimate<double> estimate(const MisTechniques<double, 2>& techniques,
                                 const MisSample<double, 2>& sample) const {
        MisSample<double, 2> alone = sample;
        alone.pdf[0] = 0;
        if (J == 0) alone = {};
        return BalanceHeuristic().estimate<J>(techniques, alone);
    }
};

template <class Light>
void expect_mutants_rejected(const std::vector<ReflectedLight<Light>>& list) {
    using Pair = nusselt::ProjectedSolidAngleAndLtc;
    const auto rejected = [&](const auto& mutant, Counts counts) {
        return reject(list,
                      [&](const auto& reflected) { return p_value_of<Pair>(reflected, mutant, counts); });
    };
    EXPECT_TRUE(rejected(SpecularTechniqueAlone(), {1, 1}));
    EXPECT_TRUE(rejected(Mutant{WeightedBalanceHeuristic(),
                                [](auto& t, auto&) {
                                    t.unshadowed[0] = {0, 0, 0};
                                }},
                         {1, 1}))
        << "albedo of metals not clamped";
    EXPECT_TRUE(rejected(
        Mutant{WeightedBalanceHeuristic(), [](auto& t, auto&) { t.samples[0] = t.samples[1] = 1; }}, {1, 3}))
        << "numbers of samples ignored";
    EXPECT_TRUE(rejected(Mutant{Optimal{0.5}, [](auto&, auto& s) { s.pdf[1] *= 1.05; }}, {1, 1}))
        << "density wrong by 5 %";
}

TEST(DirectLightMutants, OfPolygonsAreRejected) {
    const auto list = reflected_polygons(surfaces(kAllRoughnesses));
    expect_mutants_rejected(list);
    using Pair = nusselt::SolidAngleAndBrdf<nusselt::GgxVisibleNormals>;
    const auto black_without_density = [](auto&, auto& s) {
        if (sum_of_channels(nusselt::detail::sum_of(s.component)) == 0) s.pdf[0] = 0;
    };
    const Mutant mutant{Optimal{0.5}, black_without_density};
    EXPECT_TRUE(reject(list, [&](const auto& reflected) { return p_value_of<Pair>(reflected, mutant); }))
        << "samples below the surface taken to be impossible";
}

TEST(DirectLightMutants, OfLinesAreRejected) {
    expect_mutants_rejected(reflected_lines(surfaces(kAllRoughnesses)));
}

TEST(DirectLightMutants, OfCylindersAreRejected) {
    expect_mutants_rejected(reflected_cylinders(surfaces(kAllRoughnesses)));
}

} // namespace
} // namespace nusselt_test
