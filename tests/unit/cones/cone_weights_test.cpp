/// Tests of the weights of samples: how far densities are from perfect importance sampling.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped_ltc.h>
#include <nusselt/cones/cone_clipped_solid_angle.h>
#include <nusselt/cones/cone_projected_solid_angle.h>
#include <nusselt/cones/cone_solid_angle.h>

#include "common/effort.h"
#include "cones/lobe_part.h"
#include "cones/round_cases.h"

namespace nusselt_test {
namespace {

using nusselt::ConeSweep;
using nusselt::EllipticCone;

/// Calls f with jittered places of the unit square. The centres of cells would miss what the weights are at its border,
/// where they differ most.
template <class Function>
void for_each_place(RandomLights& jitter, const Function& f) {
    const int side = at_effort(12, 20);
    const auto coordinate = [&](int cell) {
        const auto x = static_cast<float>((cell + jitter.uniform(0, 1)) / side);
        return std::min(x, std::nextafter(1.0f, 0.0f));
    };
    for (int k = 0; k < side * side; ++k) {
        const float x = coordinate(k % side);
        f(nusselt::Vec2<float>{x, coordinate(k / side)});
    }
}

/// Weights of the samples of a light, over their mean.
/// \param weight of the sample at a place
template <class Weight>
std::vector<double> weights_of(RandomLights& jitter, const Weight& weight) {
    std::vector<double> weights;
    double sum = 0;
    for_each_place(jitter, [&](const auto& u) {
        weights.push_back(weight(u));
        sum += weights.back();
    });
    for (double& w : weights) w *= static_cast<double>(weights.size()) / sum;
    return weights;
}

double deviation(const std::vector<double>& weights) {
    double squares = 0;
    for (const double w : weights) squares += (w - 1) * (w - 1);
    return std::sqrt(squares / static_cast<double>(weights.size()));
}

double quantile(std::vector<double>& values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Larger half-angles by their tangents, and how much longer than wide cones are at most.
struct Cones {
    const char* name;
    double least, largest, aspect;
    double few, many; ///< upper bounds of the weight over the mean of one light, with 16 and 64 places
};
// The bounds with 64 places are our targets for the first three rows: 1.2, 1.3 and 2. With 16 places, few of the
// cones of the third row exceed the target.
constexpr Cones kCones[] = {{"1e-4 to 0.1", 1e-4, 0.1, 10, 1.2, 1.2},
                            {"0.1 to 1", 0.1, 1, 100, 1.3, 1.3},
                            {"1 to 3", 1, 3, 10, 2.5, 2},
                            {"3 to 30", 3, 30, 10, 3, 2},
                            {"3 to 100", 3, 100, 100, 6, 6}};

/// A cone that the horizon cuts.
EllipticCone<float> cut_cone(RandomLights& random, const Cones& cones) {
    const auto frame = nusselt::Frame<double>::from_normal(random.direction());
    const double turn = random.uniform(0, 3.14159);
    const auto e1 = std::cos(turn) * frame.t + std::sin(turn) * frame.b, e2 = cross(frame.n, e1);
    const double a = random.logarithmic(cones.least, cones.largest);
    const double b = a / random.logarithmic(1, cones.aspect);
    // The axis turns around e1 so that the horizon cuts the disk at a random height.
    const double end = 1 - random.logarithmic(1e-4, 1);
    const double height = random.uniform(-1, 1) < 0 ? -end : end;
    const double azimuth = random.uniform(-3.14159, 3.14159);
    const double na = std::cos(azimuth) * a, nb = std::sin(azimuth) * b;
    const nusselt::Vec3<double> normal =
        normalize(std::cos(azimuth) * e1 + std::sin(azimuth) * e2 + (height * std::hypot(na, nb)) * frame.n);
    // The world turns so that this normal is +z.
    const auto world = nusselt::Frame<double>::from_normal(normal);
    const auto local = [&](const auto& v) { return nusselt::broadcast<float>(world.to_local(v)); };
    const double largest = std::max({a, b, 1.0});
    EllipticCone<float> cone{};
    cone.e1 = local(e1);
    cone.e2 = local(e2);
    cone.e3 = local(frame.n);
    cone.a = static_cast<float>(a / largest);
    cone.b = static_cast<float>(b / largest);
    cone.c = static_cast<float>(1 / largest);
    cone.is_visible = true;
    return cone;
}

struct WeightsOfCones {
    std::vector<double> largest, deviations; ///< of each cone
    int constant = 0;                        ///< cones

    double most() { return quantile(largest, 1); }
    void print(const Cones& cones, int places) {
        std::printf("| %s | to 1 : %.0f | %d | %.0f %% | %.4f / %.4f | %.0e / %.0e / %.0e |\n", cones.name,
                    cones.aspect, places, 100.0 * constant / static_cast<double>(largest.size()),
                    quantile(largest, 0.99), most(), quantile(deviations, 0.5), quantile(deviations, 0.99),
                    quantile(deviations, 1));
    }
};

template <int Places>
WeightsOfCones weights_of_cones(const Cones& cones) {
    RandomLights random(41), jitter(61);
    WeightsOfCones result;
    for (int i = 0; i < at_effort(400, 30'000); ++i) {
        const ConeSweep<float, Places> sweep(cut_cone(random, cones));
        if (!(sweep.measure() > 0)) continue;
        const std::vector<double> weights = weights_of(jitter, [&](const auto& u) {
            return 1 / static_cast<double>(sweep.density_per_cosine(sweep.sample(u).wi));
        });
        result.largest.push_back(*std::max_element(weights.begin(), weights.end()));
        result.deviations.push_back(deviation(weights));
        if (result.deviations.back() < 1e-6) ++result.constant;
    }
    return result;
}

TEST(ConeWeightsTest, ConesThatTheHorizonCutsHaveBoundedWeights) {
    for (const Cones& cones : kCones) {
        auto few = weights_of_cones<nusselt::kConePlaces>(cones);
        auto many = weights_of_cones<nusselt::kFineConePlaces>(cones);
        ASSERT_GT(few.largest.size(), 300u) << cones.name;
        EXPECT_LE(few.most(), cones.few) << cones.name;
        EXPECT_LE(many.most(), cones.many) << cones.name;
        EXPECT_LE(many.most(), few.most()) << cones.name;
        if (!at_effort(false, true)) continue;
        few.print(cones, nusselt::kConePlaces);
        many.print(cones, nusselt::kFineConePlaces);
    }
}

/// Weights of the samples of a technique for solid angle, over their mean.
template <class Technique>
std::vector<double> weights_by_solid_angle(RandomLights& jitter, const Technique& technique) {
    return weights_of(jitter,
                      [&](const auto& u) { return 1 / static_cast<double>(technique.sample(u).pdf); });
}

/// The largest difference of a weight from the mean of its light.
double spread(const std::vector<double>& weights) {
    double largest = 0;
    for (const double w : weights) largest = std::max(largest, std::fabs(w - 1));
    return largest;
}

template <template <class> class Light>
auto by_solid_angle(const Light<float>& light) {
    return nusselt::ConeSolidAngle<float, Light>(light);
}
template <int Places, template <class> class Light>
auto by_clipped_solid_angle(const Light<float>& light) {
    return nusselt::ConeClippedSolidAngle<float, Light, Places>(light);
}
template <template <class> class Light>
auto by_projected_solid_angle(const Light<float>& light) {
    return nusselt::ConeProjectedSolidAngle<float, Light>(light);
}

TEST(ConeWeightsTest, SolidAngleHasNearlyConstantWeights) {
    RandomLights random(43), jitter(61);
    double least = 1, largest = 1;
    for (int i = 0; i < at_effort(400, 30'000); ++i) {
        const Place place = kPlaces[i % 6];
        with_light<float>(random(kShapes[i % 4], place), [&](const auto& light) {
            const std::vector<double> weights = weights_by_solid_angle(jitter, by_solid_angle(light));
            const auto [low, high] = std::minmax_element(weights.begin(), weights.end());
            least = std::min(least, *low);
            largest = std::max(largest, *high);
        });
    }
    if (at_effort(false, true)) std::printf("| solid angle | %.4f | %.4f |\n", least, largest);
    EXPECT_GE(least, 0.99);
    EXPECT_LE(largest, 1.015);
}

struct Spread {
    const char* name;
    Place place;
    double few, many; ///< upper bounds of 99 % of the lights, for kConePlaces and kFineConePlaces
};

/// Where the horizon cuts a light. One of several thousand near or thin ones is interpolated linearly, with any number of places.
TEST(ConeWeightsTest, ClippedSolidAngleHasNearlyConstantWeights) {
    constexpr Spread kSpreads[] = {
        {"ordinary", Place::ordinary, 5e-3, 1e-4},   {"at the horizon", Place::at_horizon, 8e-3, 1e-4},
        {"tiny", Place::tiny, 5e-4, 1e-4},           {"edge-on", Place::edge_on, 6e-3, 1e-4},
        {"elongated", Place::elongated, 0.01, 1e-4}, {"near", Place::near, 0.15, 1e-3},
        {"needles", Place::needle, 0.15, 0.01}};
    for (const Spread& s : kSpreads) {
        RandomLights random(47), jitter(61);
        std::vector<double> few, many;
        for (int i = 0; i < at_effort(200, 10'000); ++i) {
            const RoundLight light = random(kShapes[i % 4], s.place);
            const Silhouette silhouette = silhouette_of(light);
            if (std::fabs(silhouette.center.z) >= std::hypot(silhouette.u.z, silhouette.v.z)) continue;
            with_light<float>(light, [&](const auto& l) {
                const auto coarse = by_clipped_solid_angle<nusselt::kConePlaces>(l);
                const auto fine = by_clipped_solid_angle<nusselt::kFineConePlaces>(l);
                few.push_back(spread(weights_by_solid_angle(jitter, coarse)));
                many.push_back(spread(weights_by_solid_angle(jitter, fine)));
            });
        }
        ASSERT_GT(few.size(), 10u) << s.name;
        const double most_few = quantile(few, 0.99), most_many = quantile(many, 0.99);
        if (at_effort(false, true))
            std::printf("| %s | %zu | %.1e / %.1e | %.1e / %.1e |\n", s.name, few.size(), most_few,
                        few.back(), most_many, many.back());
        EXPECT_LE(most_few, s.few) << s.name;
        EXPECT_LE(most_many, s.many) << s.name;
    }
}

struct LobeWeights {
    std::vector<double> least, largest, deviations; ///< of each light

    void add(const std::vector<double>& weights) {
        const auto [low, high] = std::minmax_element(weights.begin(), weights.end());
        least.push_back(*low);
        largest.push_back(*high);
        deviations.push_back(deviation(weights));
    }
    /// Of 99 % of the lights, the largest difference of a weight from the mean.
    double spread() { return std::max(1 - quantile(least, 0.01), quantile(largest, 0.99) - 1); }
    void print(const char* name, int places) {
        std::printf("| %s | %d | %zu | %.4f, %.4f, %.3f | %.4f, %.4f, %.3f | %.0e, %.0e, %.0e |\n", name,
                    places, least.size(), quantile(least, 0.5), quantile(least, 0.01), quantile(least, 0),
                    quantile(largest, 0.5), quantile(largest, 0.99), quantile(largest, 1),
                    quantile(deviations, 0.5), quantile(deviations, 0.99), quantile(deviations, 1));
    }
};

/// \return weights of the lights of one class that the surface cuts, in lobes of any inclination.
template <int Places>
LobeWeights weights_of_clipped_lobes(Place place) {
    RandomLights random(59), jitter(61);
    LobeWeights result;
    for (int i = 0; i < at_effort(600, 10'000); ++i) {
        const RoundLight light = random(kShapes[i % 4], place);
        const auto lobe = random_lobe(random);
        if (LobePart(silhouette_of(light), lobe_of<long double>(lobe)).part() != LobePart::Part::cut)
            continue;
        const auto ltc = lobe_of<float>(lobe);
        with_light<float>(light, [&]<template <class> class Light>(const Light<float>& l) {
            const nusselt::ConeClippedLtc<float, Light, nusselt::kConeSteps<float>, Places> technique(l, ltc);
            if (!(technique.measure() > 0)) return;
            result.add(weights_of(jitter, [&](const auto& u) {
                const auto s = technique.sample(u);
                return s.pdf > 0 ? static_cast<double>(ltc.density(s.wi)) / static_cast<double>(s.pdf) : 0;
            }));
        });
    }
    return result;
}

TEST(ConeWeightsTest, LobesAboveTheSurfaceHaveNearlyConstantWeights) {
    constexpr Spread kSpreads[] = {
        {"ordinary", Place::ordinary, 0.1, 1e-3},   {"at the horizon", Place::at_horizon, 0.15, 1e-3},
        {"tiny", Place::tiny, 1e-3, 1e-3},          {"edge-on", Place::edge_on, 0.1, 1e-3},
        {"elongated", Place::elongated, 0.3, 1e-3}, {"near", Place::near, 0.4, 0.01},
        {"needles", Place::needle, 0.4, 0.01},      {"touching", Place::touching, 0.6, 0.1}};
    for (const Spread& s : kSpreads) {
        auto few = weights_of_clipped_lobes<nusselt::kConePlaces>(s.place);
        auto many = weights_of_clipped_lobes<nusselt::kFineConePlaces>(s.place);
        ASSERT_GT(few.least.size(), 30u) << s.name;
        EXPECT_LE(few.spread(), s.few) << s.name;
        EXPECT_LE(many.spread(), s.many) << s.name;
        if (!at_effort(false, true)) continue;
        few.print(s.name, nusselt::kConePlaces);
        many.print(s.name, nusselt::kFineConePlaces);
    }
}

/// The mean and the mean square of the error of one sample of diffuse light of a radiance of 1.
class Noise {
public:
    /// \param expected the projected solid angle of the light
    template <class Technique>
    void add(RandomLights& jitter, const Technique& technique, double expected) {
        for_each_place(jitter, [&](const auto& u) {
            const auto s = technique.sample(u);
            const double cosine = std::max(static_cast<double>(s.wi.z), 0.0);
            const double error = (s.pdf > 0 ? cosine / static_cast<double>(s.pdf) : 0) - expected;
            squares_ += error * error;
            sum_ += expected;
            ++count_;
        });
    }
    double over_mean() const { return std::sqrt(squares_ * count_) / sum_; }

private:
    double squares_ = 0, sum_ = 0;
    int count_ = 0;
};

/// As in an image: noise is that of all lights over the mean of all.
TEST(ConeWeightsTest, DiffuseLightOfSpheresAndDisksHasNearlyNoNoise) {
    for (const Shape shape : {Shape::sphere, Shape::disk}) {
        RandomLights random(53), jitter(61);
        Noise above, above_by_solid_angle, cut, cut_by_solid_angle;
        for (int i = 0; i < at_effort(1000, 30'000); ++i) {
            const RoundLight light = random(shape, i % 2 == 0 ? Place::ordinary : Place::at_horizon);
            const Silhouette silhouette = silhouette_of(light);
            const auto swing = std::hypot(silhouette.u.z, silhouette.v.z);
            if (silhouette.center.z <= -swing) continue;
            const bool is_cut = silhouette.center.z < swing;
            const auto expected = static_cast<double>(projected_solid_angle_of(silhouette));
            with_light<float>(light, [&](const auto& l) {
                (is_cut ? cut : above).add(jitter, by_projected_solid_angle(l), expected);
                (is_cut ? cut_by_solid_angle : above_by_solid_angle).add(jitter, by_solid_angle(l), expected);
            });
        }
        if (at_effort(false, true))
            std::printf("| noise | %.1e / %.1e | %.1e / %.1e |\n", above.over_mean(),
                        above_by_solid_angle.over_mean(), cut.over_mean(), cut_by_solid_angle.over_mean());
        EXPECT_LE(above.over_mean(), 1e-4);
        EXPECT_GT(above_by_solid_angle.over_mean(), 1e-2);
        EXPECT_LE(cut.over_mean(), 0.2 * cut_by_solid_angle.over_mean());
    }
}

} // namespace
} // namespace nusselt_test
