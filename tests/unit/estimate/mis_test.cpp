/// Tests of heuristics on small domains. Expectations and variances come from enumeration, not from sampling.

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/simd/pack.h>

#include "mis_models.h"

namespace nusselt_test {
namespace {

using nusselt::BalanceHeuristic;
using nusselt::MisEstimate;
using nusselt::MisSample;
using nusselt::MisTechniques;
using nusselt::OneSampleChoice;
using nusselt::PowerHeuristic;
using nusselt::SeparateComponents;
using nusselt::WeightedBalanceHeuristic;
using ClampedOptimal = nusselt::ClampedOptimalHeuristic<double>;
using Optimal = nusselt::OptimalHeuristic<double>;

constexpr double kRounding = 1e-13;

const Colour kDiffuse{0.8, 0.3, 0.05}, kGlossy{0.2, 0.5, 0.9}, kCoat{0.1, 0.04, 0.4};

std::vector<MisModel<2>> pairs(MisModel<2> (*make)(const Colour (&)[2], const double (&)[2])) {
    return {make({kDiffuse, kGlossy}, {1, 1}), make({kDiffuse, kGlossy}, {1, 3}),
            make({0.01 * kDiffuse, kGlossy}, {4, 1})};
}
std::vector<MisModel<3>> triples(MisModel<3> (*make)(const Colour (&)[3], const double (&)[3])) {
    return {make({kDiffuse, kGlossy, kCoat}, {1, 1, 1}), make({kDiffuse, kGlossy, kCoat}, {2, 1, 5})};
}

/// The largest error of an expectation relative to the integral, over the models in which nothing fits.
template <class Heuristic>
double largest_bias(const Heuristic& heuristic) {
    double largest = 0;
    const auto check = [&](const auto& model) {
        const Colour truth = model.integral();
        largest = std::max(largest, distance(expectation(heuristic, model), truth) / truth.x);
    };
    for (const auto& model : pairs(misfitting_model)) check(model);
    for (const auto& model : triples(misfitting_model)) check(model);
    return largest;
}

TEST(Mis, IsUnbiased) {
    EXPECT_LT(largest_bias(BalanceHeuristic()), kRounding);
    EXPECT_LT(largest_bias(PowerHeuristic()), kRounding);
    EXPECT_LT(largest_bias(WeightedBalanceHeuristic()), kRounding);
    EXPECT_LT(largest_bias(SeparateComponents()), kRounding);
    for (const double visibility : {0.0, 0.3, 1.0})
        EXPECT_LT(largest_bias(ClampedOptimal{visibility}), kRounding) << visibility;
    for (const double visibility : {0.0, 0.5, 1.0})
        EXPECT_LT(largest_bias(Optimal{visibility}), kRounding) << visibility;
}

/// Changes the constant of samples for which the BRDF is zero. \tparam Kept computes the new constant from the
/// constant and the coefficient that is part of it.
template <class Kept>
struct OptimalWithoutBlackSamples {
    Kept kept;

    template <int J, int K>
    MisEstimate<double> estimate(const MisTechniques<double, K>& techniques,
                                 const MisSample<double, K>& sample) const {
        MisEstimate<double> result = Optimal{0.5}.template estimate<J>(techniques, sample);
        const Colour coefficient = 0.5 / techniques.samples[J] * techniques.unshadowed[J];
        if (!(nusselt::detail::sum_of(sample.component).x > 0))
            result.constant = kept(result.constant, coefficient);
        return result;
    }
};

template <class Kept>
OptimalWithoutBlackSamples(Kept) -> OptimalWithoutBlackSamples<Kept>;

/// In the mean, the coefficient that a sample adds and the control variate that it subtracts cancel at each point. A
/// renderer may omit both, but not only one of them.
TEST(Mis, OptimalMayLeaveOutBlackSamplesButNotByHalves) {
    const OptimalWithoutBlackSamples whole{[](const Colour&, const Colour&) { return grey(0); }};
    const OptimalWithoutBlackSamples half{[](const Colour& all, const Colour& added) { return all - added; }};
    EXPECT_LT(largest_bias(whole), kRounding);
    EXPECT_GT(largest_bias(half), 0.01);
}

/// Passes wrong facts about the techniques to a heuristic.
template <class Heuristic, class Change>
struct Mutant {
    Heuristic heuristic;
    Change change;

    template <int J, int K>
    MisEstimate<double> estimate(const MisTechniques<double, K>& techniques,
                                 const MisSample<double, K>& sample) const {
        MisTechniques<double, K> changed = techniques;
        change(changed);
        return heuristic.template estimate<J>(changed, sample);
    }
};

constexpr auto kOneSampleEach = [](auto& techniques) {
    for (double& count : techniques.samples) count = 1;
};

TEST(Mis, MutantsAreBiased) {
    const Mutant<WeightedBalanceHeuristic, decltype(kOneSampleEach)> equal_counts{};
    EXPECT_GT(largest_bias(equal_counts), 0.1);
    const auto without_diffuse_coefficient = [](auto& techniques) { techniques.unshadowed[0] = grey(0); };
    const Mutant<WeightedBalanceHeuristic, decltype(without_diffuse_coefficient)> metal{
        {}, without_diffuse_coefficient};
    EXPECT_GT(largest_bias(metal), 0.1);
}

/// On a metal, the weight of the diffuse technique beyond the lobe comes from the clamped albedo alone.
TEST(Mis, ClampedAlbedoKeepsMetalsUnbiased) {
    auto model = misfitting_model({grey(0), kGlossy}, {1, 1});
    const double truth = model.integral().x;
    EXPECT_LT(expectation(WeightedBalanceHeuristic(), model).x, 0.9 * truth);
    model.techniques.unshadowed[0] = grey(nusselt::kSmallestDiffuseAlbedo);
    EXPECT_NEAR(expectation(WeightedBalanceHeuristic(), model).x / truth, 1, kRounding);
}

template <class Heuristic>
double largest_variance_of_fits(const Heuristic& heuristic) {
    double largest = 0;
    for (const auto& model : pairs(fitting_model))
        largest = std::max(largest, largest_variance(heuristic, model));
    for (const auto& model : triples(fitting_model))
        largest = std::max(largest, largest_variance(heuristic, model));
    return largest;
}

TEST(Mis, NoNoiseWhereTheCoefficientsAreRight) {
    EXPECT_LT(largest_variance_of_fits(WeightedBalanceHeuristic()), kRounding);
    EXPECT_LT(largest_variance_of_fits(ClampedOptimal{1}), kRounding);
    EXPECT_LT(largest_variance_of_fits(Optimal{1}), kRounding);
    EXPECT_GT(largest_variance_of_fits(BalanceHeuristic()), 1e-3);
    EXPECT_GT(largest_variance_of_fits(ClampedOptimal{0.5}), 1e-3);
    EXPECT_GT(largest_variance_of_fits(Optimal{0.5}), 1e-3);
}

/// Calls check(a, b) with the estimates of two heuristics for each sample of technique J.
template <int J, int K, class A, class B, class Check>
void compare(const MisModel<K>& model, const A& a, const B& b, const Check& check) {
    for (const auto& cell : model.cells)
        if (cell.pdf[J] > 0)
            check(a.template estimate<J>(model.techniques, cell),
                  b.template estimate<J>(model.techniques, cell));
}

TEST(Mis, ClampedOptimalGoesFromBalanceToWeightedBalance) {
    const auto same = [](const auto& a, const auto& b) {
        EXPECT_EQ(distance(a.shadowed, b.shadowed), 0);
        EXPECT_EQ(distance(a.constant, b.constant), 0);
    };
    for (const auto& model : triples(misfitting_model)) {
        compare<0>(model, ClampedOptimal{0}, BalanceHeuristic(), same);
        compare<2>(model, ClampedOptimal{0}, BalanceHeuristic(), same);
        compare<0>(model, ClampedOptimal{1}, WeightedBalanceHeuristic(), same);
        compare<2>(model, ClampedOptimal{1}, WeightedBalanceHeuristic(), same);
        compare<1>(model, Optimal{0}, BalanceHeuristic(), same);
    }
}

/// A sample in shadow contributes only its constant, which is negative at times for the optimal heuristic.
TEST(Mis, OnlyTheOptimalHeuristicIsEverNegative) {
    bool negative = false;
    for (const auto& model : pairs(misfitting_model)) {
        compare<1>(model, Optimal{1}, ClampedOptimal{0.5}, [&](const auto& optimal, const auto& clamped) {
            negative |= optimal.constant.x < 0;
            EXPECT_GE(clamped.shadowed.x, 0);
            EXPECT_EQ(distance(clamped.constant, grey(0)), 0);
        });
    }
    EXPECT_TRUE(negative);
}

/// A model of three techniques, one of which cannot sample, and the same model without that technique.
struct WithAndWithout {
    MisModel<3> with;
    MisModel<2> without;

    WithAndWithout()
        : with(misfitting_model({kDiffuse, grey(0), kCoat}, {2, 1, 5})),
          without(empty_model({kDiffuse, kCoat}, {2, 5})) {
        for (std::size_t i = 0; i < with.cells.size(); ++i) {
            auto& cell = with.cells[i];
            cell.pdf[1] = 0;
            // Technique 0 takes over component 1.
            without.cells[i] = {{cell.pdf[0], cell.pdf[2]},
                                {cell.component[0] + cell.component[1], cell.component[2]}};
        }
        without.visibility = with.visibility;
    }
};

template <class Heuristic>
void expect_drops_out(const Heuristic& heuristic) {
    const WithAndWithout models;
    EXPECT_LT(distance(expectation(heuristic, models.without), models.without.integral()), kRounding);
    for (std::size_t i = 0; i < models.with.cells.size(); ++i) {
        const auto& three = models.with.cells[i];
        const auto& two = models.without.cells[i];
        const auto expect_same = [](const auto& a, const auto& b) {
            EXPECT_LT(distance(a.shadowed, b.shadowed), kRounding);
            EXPECT_LT(distance(a.constant, b.constant), kRounding);
        };
        const auto& with = models.with.techniques;
        const auto& without = models.without.techniques;
        expect_same(heuristic.template estimate<0>(with, three),
                    heuristic.template estimate<0>(without, two));
        expect_same(heuristic.template estimate<2>(with, three),
                    heuristic.template estimate<1>(without, two));
    }
    // A technique that cannot sample returns densities of zero.
    const auto nothing = heuristic.template estimate<1>(models.with.techniques, MisSample<double, 3>{});
    EXPECT_EQ(distance(nothing.shadowed + nothing.constant, grey(0)), 0);
}

TEST(Mis, ATechniqueThatCannotSampleDropsOut) {
    expect_drops_out(BalanceHeuristic());
    expect_drops_out(PowerHeuristic());
    expect_drops_out(WeightedBalanceHeuristic());
    expect_drops_out(ClampedOptimal{0.5});
    expect_drops_out(Optimal{0.5});
    expect_drops_out(SeparateComponents());
}

/// A technique that takes no samples but still returns a density takes weight from the others: the estimate is too
/// dark.
TEST(Mis, ATechniqueThatCannotSampleMustHaveNoDensity) {
    auto model = misfitting_model({kDiffuse, kGlossy}, {1, 1});
    const auto diffuse_only = [&] {
        Colour sum = grey(0);
        for (std::size_t i = 0; i < model.cells.size(); ++i) {
            const auto& cell = model.cells[i];
            const auto estimate = BalanceHeuristic().estimate<0>(model.techniques, cell);
            sum = sum + cell.pdf[0] * model.visibility[i] * estimate.shadowed;
        }
        return sum;
    };
    EXPECT_LT(diffuse_only().x, 0.9 * model.integral().x);
    for (auto& cell : model.cells) cell.pdf[1] = 0;
    EXPECT_NEAR(diffuse_only().x / model.integral().x, 1, kRounding);
}

TEST(Mis, ExtremeDensitiesOfFloat) {
    const auto share = [](float p0, float p1) {
        const MisTechniques<float, 2> techniques{{1, 3}, {{1, 1, 1}, {1, 1, 1}}};
        const MisSample<float, 2> sample{{p0, p1}, {{p0, p0, p0}, {p1, p1, p1}}};
        return PowerHeuristic().estimate<1>(techniques, sample).shadowed.x;
    };
    // The integrand is 2 p, the weight 9 / 10, and the technique of density p takes three samples.
    for (const float p : {1e30f, 1e-30f, 1e-37f, 3e37f}) EXPECT_NEAR(share(p, p), 0.6f, 1e-6f) << p;
    EXPECT_EQ(share(1e30f, 1e-30f), 0);
    EXPECT_NEAR(share(1e-30f, 1e30f), 1.0f / 3, 1e-6f);
    // Denormal densities.
    EXPECT_TRUE(std::isfinite(share(1e-42f, 0)));
    EXPECT_TRUE(std::isfinite(share(1e-42f, 1e-42f)));
}

template <int K>
MisTechniques<double, K> with_coefficients(const Colour (&coefficients)[K]) {
    MisTechniques<double, K> techniques{};
    for (int k = 0; k < K; ++k) techniques.unshadowed[k] = coefficients[k];
    return techniques;
}

template <int K>
void expect_one_sample_unbiased(const MisModel<K>& model) {
    const OneSampleChoice<double, K> choice(model.techniques);
    Colour sum = grey(0);
    double total = 0;
    for (int k = 0; k < K; ++k) {
        total += choice.probability(k);
        for (std::size_t i = 0; i < model.cells.size(); ++i)
            sum = sum + choice.probability(k) * model.cells[i].pdf[k] * model.visibility[i] *
                            choice.estimate(model.cells[i]).shadowed;
    }
    EXPECT_NEAR(total, 1, kRounding);
    EXPECT_LT(distance(sum, model.integral()), kRounding);
}

TEST(OneSample, IsUnbiased) {
    for (const auto& model : pairs(misfitting_model)) expect_one_sample_unbiased(model);
    for (const auto& model : triples(misfitting_model)) expect_one_sample_unbiased(model);
}

TEST(OneSample, ProbabilitiesAreLuminances) {
    // The luminance weights of Rec. 709 are 0.2126, 0.7152 and 0.0722.
    const OneSampleChoice<double, 3> choice(with_coefficients({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_NEAR(choice.probability(0), 0.2126, 1e-15);
    EXPECT_NEAR(choice.probability(1), 0.7152, 1e-15);
    EXPECT_NEAR(choice.probability(2), 0.0722, 1e-15);
}

TEST(OneSample, LeavesARandomNumberBehind) {
    constexpr int kCount = 1 << 14;
    const OneSampleChoice<double, 3> choice(with_coefficients({grey(0.2), grey(0.5), grey(0.1)}));
    std::vector<double> left[3];
    for (int i = 0; i < kCount; ++i) {
        const auto decision = choice.decide((i + 0.5) / kCount);
        int chosen = 0;
        for (int k = 0; k < 3; ++k) {
            if (!decision.chosen[k]) continue;
            ++chosen;
            left[k].push_back(decision.u);
        }
        ASSERT_EQ(chosen, 1);
    }
    for (int k = 0; k < 3; ++k) {
        const auto count = static_cast<double>(left[k].size());
        ASSERT_NEAR(count, choice.probability(k) * kCount, 1);
        for (std::size_t i = 0; i < left[k].size(); ++i)
            ASSERT_NEAR(left[k][i], (static_cast<double>(i) + 0.5) / count, 1.01 / count);
    }
}

template <class T>
void expect_unit_interval(const MisTechniques<T, 2>& techniques) {
    const OneSampleChoice<T, 2> choice(techniques);
    constexpr T kLargest = 1 - std::numeric_limits<T>::epsilon() / 2;
    const T boundary = choice.probability(0);
    for (const T u : {T(0), std::numeric_limits<T>::denorm_min(), std::nextafter(boundary, T(0)), boundary,
                      std::nextafter(boundary, T(2)), T(0.5), kLargest}) {
        if (!(u < 1)) continue;
        const auto decision = choice.decide(u);
        ASSERT_TRUE(decision.chosen[0] != decision.chosen[1]) << u;
        ASSERT_TRUE(0 <= decision.u && decision.u < 1) << u;
        if (choice.probability(0) + choice.probability(1) > 0) {
            ASSERT_GT(choice.probability(decision.chosen[0] ? 0 : 1), 0) << u;
        }
    }
}

template <class T>
class OneSampleScalar : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(OneSampleScalar, Scalars);

TYPED_TEST(OneSampleScalar, StaysInTheUnitInterval) {
    using T = TypeParam;
    for (const T a : {T(0), T(1e-30L), T(1e-7L), T(0.3L), T(1), T(1e30L)})
        for (const T b : {T(0), T(1e-30L), T(1e-7L), T(0.7L), T(1e30L)})
            expect_unit_interval<T>({{1, 1}, {{a, a, a}, {b, b, b}}});
}

TYPED_TEST(OneSampleScalar, NothingToSample) {
    using T = TypeParam;
    const OneSampleChoice<T, 3> choice(MisTechniques<T, 3>{});
    for (int k = 0; k < 3; ++k) EXPECT_EQ(choice.probability(k), 0);
    EXPECT_TRUE(choice.decide(T(0.4)).chosen[2]);
    EXPECT_EQ(choice.estimate(MisSample<T, 3>{{0, 0, 0}, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}).shadowed.x, 0);
}

TEST(OneSample, LanesEqualScalars) {
    using Real = nusselt::Pack<float, nusselt::kNativeLanes<float>>;
    constexpr int kLanes = nusselt::RealTraits<Real>::kLanes;
    const MisTechniques<float, 2> techniques{{1, 1}, {{0.1f, 0.4f, 0.2f}, {0.3f, 0.1f, 0.6f}}};
    MisTechniques<Real, 2> packed{};
    Real u(0.0f);
    for (int k = 0; k < 2; ++k) packed.unshadowed[k] = nusselt::broadcast<Real>(techniques.unshadowed[k]);
    for (int i = 0; i < kLanes; ++i) u.set_lane(i, static_cast<float>(i) / kLanes);
    const auto decisions = OneSampleChoice<Real, 2>(packed).decide(u);
    const Real first = select(decisions.chosen[0], Real(1), Real(0));
    for (int i = 0; i < kLanes; ++i) {
        const auto decision = OneSampleChoice<float, 2>(techniques).decide(u.lane(i));
        EXPECT_EQ(decisions.u.lane(i), decision.u);
        EXPECT_EQ(first.lane(i) == 1, decision.chosen[0]);
    }
}

} // namespace
} // namespace nusselt_test
