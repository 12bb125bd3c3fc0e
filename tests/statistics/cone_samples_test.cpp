/// Tests that samples of spheres, disks, ellipses and ellipsoids follow the cosine, by counts in cells of the light, and that the
/// samples of all techniques follow their densities, by means of a function.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "cones/round_cases.h"
#include "hypothesis.h"
#include "ltc/reference.h"
#include "proof/hostile/round_reference.h"
#include "sampling/lights.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 20'000;
constexpr int kSide = 8;

using Random = nusselt::Vec2<float>;

/// Whether directions differ from those of the cosine in any of some lights. Tiny lights are left out: unit vectors of float do
/// not tell their parts apart.
/// \param draw function of (light, random numbers) to a direction.
template <class Draw>
bool is_rejected(const Draw& draw) {
    std::vector<double> p_values;
    RandomLights lights(21);
    UniformFloats random(4);
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near, Place::elongated}) {
        for (const Shape shape : kShapes) {
            const RoundLight light = lights(shape, place);
            const VisiblePart part(silhouette_of(light));
            const auto cosine = [](const Point& wi) { return std::max(wi.z, 0.0L); };
            std::vector<double> expected;
            long double total = 0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const long double x = static_cast<long double>(i % kSide) / kSide;
                const long double y = static_cast<long double>(i / kSide) / kSide;
                const long double share = part.integral(cosine, x, x + 1.0L / kSide, y, y + 1.0L / kSide, 12);
                total += share;
                expected.push_back(static_cast<double>(share));
            }
            if (!(total > 1e-4L)) continue;
            for (double& e : expected) e *= kSamples / static_cast<double>(total);
            std::vector<std::int64_t> observed(kSide * kSide);
            with_light<float>(light, [&](const auto& l) {
                for (int i = 0; i < kSamples; ++i) {
                    const float x = random();
                    const auto wi = draw(l, Random{x, random()});
                    const auto at = part.place_of(nusselt::broadcast<long double>(wi));
                    const int column = std::min(static_cast<int>(at.x * kSide), kSide - 1);
                    const int row = std::min(static_cast<int>(at.y * kSide), kSide - 1);
                    ++observed[static_cast<std::size_t>(row * kSide + column)];
                }
            });
            p_values.push_back(chi_square_test(expected, observed));
        }
    }
    return reject(p_values);
}

template <template <class> class Light>
nusselt::ConeProjectedSolidAngle<float, Light> technique_for(const Light<float>& light) {
    return nusselt::ConeProjectedSolidAngle<float, Light>(light);
}
template <template <class> class Light>
nusselt::ConeSolidAngle<float, Light> by_solid_angle(const Light<float>& light) {
    return nusselt::ConeSolidAngle<float, Light>(light);
}

TEST(ConeSamplesTest, FollowTheCosine) {
    EXPECT_FALSE(
        is_rejected([](const auto& light, const Random& u) { return technique_for(light).sample(u).wi; }));
}

TEST(ConeSamplesTest, SquaredRandomNumbersAreRejected) {
    EXPECT_TRUE(is_rejected([](const auto& light, const Random& u) {
        return technique_for(light).sample({u.x * u.x, u.y}).wi;
    }));
    EXPECT_TRUE(is_rejected([](const auto& light, const Random& u) {
        return technique_for(light).sample({u.x, u.y * u.y}).wi;
    }));
}

TEST(ConeSamplesTest, SolidAngleIsRejected) {
    EXPECT_TRUE(
        is_rejected([](const auto& light, const Random& u) { return by_solid_angle(light).sample(u).wi; }));
}

/// The ellipse that looks like a light.
Silhouette silhouette_of(const nusselt::FlatLightView<long double>& view) {
    return {view.center, view.u, view.v};
}
Silhouette silhouette_of(const nusselt::SolidLightView<long double>& view) {
    return {view.rim * view.center, view.u, view.v};
}

/// The integral of the importance of a technique times f over a light: of a lobe, or else of the cosine at the surface.
template <class Kind, class Function>
long double integral_of(const typename Kind::template Light<float>& light, const Function& f) {
    const Silhouette seen = silhouette_of(view_of(exact_light(light), nusselt::detail::SameSpace()));
    if constexpr (kHasLobe<Kind>) {
        // In cosine space, where the importance is a cosine and the light ends at the horizon.
        const ReferenceLobe lobe(light.lobe);
        const nusselt::Ltc<long double> back(rounded<long double>(light.lobe));
        const VisiblePart image({lobe.image(seen.center), lobe.image(seen.u), lobe.image(seen.v)});
        const auto integrand = [&](const Point& o) {
            return std::max(o.z, 0.0L) / kPi * f(normalize(back.to_shading(o)));
        };
        return image.integral(integrand, 0, 1, 0, 1, 96);
    } else {
        const auto integrand = [&](const Point& wi) { return std::max(wi.z, 0.0L) * f(wi); };
        return VisiblePart(seen).integral(integrand, 0, 1, 0, 1, 96);
    }
}

/// Whether means of the importance times a function over the density differ from integrals.
/// \param warp    maps random numbers that should be uniform.
/// \param density of (technique, sample).
template <class Kind, class Warp, class Density>
bool means_are_rejected(const Warp& warp, const Density& density) {
    std::vector<double> p_values;
    UniformFloats random(5);
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, float>(light);
        const typename Kind::template Technique<float> technique(local);
        const auto f = [](const Point& wi) { return (2 + wi.x + 0.5L * wi.y) * (1.5L + wi.z); };
        const auto importance = [&](const Point& wi) {
            if constexpr (kHasLobe<Kind>) return ReferenceLobe(local.lobe).density(wi);
            return std::max(wi.z, 0.0L);
        };
        MeanTest test;
        for (int i = 0; i < kSamples; ++i) {
            const float x = random();
            const auto s = technique.sample(warp(Random{x, random()}));
            if (!(s.pdf > 0)) continue;
            const auto wi = nusselt::broadcast<long double>(s.wi);
            test.add(importance(wi) * f(wi) / density(technique, s));
        }
        // The slack covers rounding in float and the error of the integral.
        p_values.push_back(test.p_value(kSamples, integral_of<Kind>(local, f), 1e-8L));
    }
    return reject(p_values);
}

Random unwarped(const Random& u) { return u; }
constexpr auto kOwnDensity = [](const auto&, const auto& sample) { return sample.pdf; };

template <class Kind>
class RoundSamplesTest : public ::testing::Test {};

using Types = Instances<TestedBy<StatisticsSuite, RoundKinds, RoundOnLobeKinds>, float>;
TYPED_TEST_SUITE(RoundSamplesTest, Types, InstanceNames);

TYPED_TEST(RoundSamplesTest, FollowTheirDensity) {
    EXPECT_FALSE(means_are_rejected<typename TypeParam::Kind>(unwarped, kOwnDensity));
}

TYPED_TEST(RoundSamplesTest, MutantsAreRejected) {
    using Kind = typename TypeParam::Kind;
    EXPECT_TRUE(means_are_rejected<Kind>(
        [](const Random& u) {
            return Random{u.x * u.x, u.y};
        },
        kOwnDensity));
    EXPECT_TRUE(means_are_rejected<Kind>(
        [](const Random& u) {
            return Random{u.x, u.y * u.y};
        },
        kOwnDensity));
    EXPECT_TRUE(means_are_rejected<Kind>(unwarped,
                                         [](const auto&, const auto& sample) { return 1.05f * sample.pdf; }));
}

} // namespace
} // namespace nusselt_test
