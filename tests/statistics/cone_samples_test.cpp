/// Tests that samples of spheres, disks, ellipses and ellipsoids follow the cosine, by counts in cells of the light, and that the
/// samples of all techniques follow their densities, by means of a function.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "cones/direction_integral.h"
#include "cones/lobe_image.h"
#include "cones/lune_integral.h"
#include "cones/round_cases.h"
#include "hypothesis.h"
#include "ltc/reference.h"
#include "proof/hostile/round_reference.h"
#include "proof/techniques/fine_round_kinds.h"
#include "replicates.h"
#include "sampling/lights.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 20'000;
constexpr int kSide = 8;
constexpr double kHopeless = 1e-6; ///< p-values below it are rejected among up to a thousand

using Random = nusselt::Vec2<float>;

/// A light, and how many of the samples are expected in the cells of a grid on it.
struct Cells {
    RoundLight light;
    VisiblePart part;
    std::vector<double> expected;
};

/// Tiny lights are left out: unit vectors of float do not tell their parts apart.
std::vector<Cells> make_cells() {
    std::vector<Cells> result;
    RandomLights lights(21);
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near, Place::elongated}) {
        for (const Shape shape : kShapes) {
            const RoundLight light = lights(shape, place);
            Cells cells{light, VisiblePart(silhouette_of(light)), {}};
            const auto cosine = [](const Point& wi) { return std::max(wi.z, 0.0L); };
            long double total = 0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const long double x = static_cast<long double>(i % kSide) / kSide;
                const long double y = static_cast<long double>(i / kSide) / kSide;
                const long double share =
                    cells.part.integral(cosine, x, x + 1.0L / kSide, y, y + 1.0L / kSide, 12);
                total += share;
                cells.expected.push_back(static_cast<double>(share));
            }
            if (!(total > 1e-4L)) continue;
            for (double& e : cells.expected) e *= kSamples / static_cast<double>(total);
            result.push_back(cells);
        }
    }
    return result;
}

/// Whether directions differ from those of the cosine in any of some lights.
/// \param draw function of (light, random numbers) to a direction.
template <class Draw>
bool is_rejected(const Draw& draw) {
    static const std::vector<Cells> all_cells = make_cells();
    std::vector<double> p_values;
    UniformFloats random(4);
    for (const auto& [light, part, expected] : all_cells) {
        std::vector<std::int64_t> observed(kSide * kSide);
        with_light<float>(light, [&, &grid = part](const auto& l) {
            for (int i = 0; i < kSamples; ++i) {
                const float x = random();
                const auto wi = draw(l, Random{x, random()});
                const auto at = grid.place_of(nusselt::broadcast<long double>(wi));
                const int column = std::min(static_cast<int>(at.x * kSide), kSide - 1);
                const int row = std::min(static_cast<int>(at.y * kSide), kSide - 1);
                ++observed[static_cast<std::size_t>(row * kSide + column)];
            }
        });
        p_values.push_back(chi_square_test(expected, observed));
        if (p_values.back() < kHopeless) return true;
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

/// The shape of the lights of a kind.
template <class Kind>
constexpr Shape shape_of() {
    using Light = typename Kind::template Light<float>;
    if constexpr (std::is_base_of_v<nusselt::Sphere<float>, Light>) return Shape::sphere;
    if constexpr (std::is_base_of_v<nusselt::Disk<float>, Light>) return Shape::disk;
    if constexpr (std::is_base_of_v<nusselt::Ellipse<float>, Light>) return Shape::ellipse;
    return Shape::ellipsoid;
}

/// The lights on which all techniques are tested, and random ones where a few places of the rim do not suffice.
template <class Kind>
std::vector<typename Kind::template Light<float>> lights_for() {
    std::vector<typename Kind::template Light<float>> lights;
    for (const auto& light : cases<Kind>()) lights.push_back(light_for<Kind, float>(light));
    RandomLights random(22);
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near, Place::elongated}) {
        for (int repeat = 0; repeat < 2; ++repeat) {
            const auto [shape, center, axis] = random(shape_of<Kind>(), place);
            const RoundCase light{"random", {center, {axis[0], axis[1], axis[2]}}};
            if constexpr (kHasLobe<Kind>) {
                const auto& lobe = lobe_cases()[static_cast<std::size_t>(repeat)];
                lights.push_back(light_for<Kind, float>(OnLobe<RoundCase>{light, lobe.coefficients}));
            } else {
                lights.push_back(light_for<Kind, float>(light));
            }
        }
    }
    return lights;
}

long double test_function(const Point& wi) { return (2 + wi.x + 0.5L * wi.y) * (1.5L + wi.z); }

/// The integral of the importance of a technique times a function over a light: of a lobe, or else of the cosine at the surface.
template <class Kind>
double integral_of(const typename Kind::template Light<float>& light) {
    constexpr long double kTolerance = 1e-8L;
    if constexpr (kHasLobe<Kind>) {
        // In cosine space, where the importance is a cosine and the light ends at the horizon.
        const nusselt::Ltc<long double> back(rounded<long double>(light.lobe));
        const auto integrand = [&](const Point& o) {
            return std::max(o.z, 0.0L) / kPi * test_function(normalize(back.to_shading(o)));
        };
        const auto image = image_of(exact_light(light), ReferenceLobe(light.lobe));
        if constexpr (Kind::kHorizon == nusselt::hostile::Horizon::clipped) {
            const LuneRegion lune(nusselt::hostile::contour_of(image),
                                  normalize(back.normal_to_cosine({0, 0, 1})));
            return static_cast<double>(lune.integral(integrand, kTolerance));
        }
        return static_cast<double>(
            DirectionRegion(image, DirectionRegion::Part::above_horizon).integral(integrand, kTolerance));
    } else {
        const auto integrand = [&](const Point& wi) { return std::max(wi.z, 0.0L) * test_function(wi); };
        return static_cast<double>(DirectionRegion(exact_light(light), DirectionRegion::Part::above_horizon)
                                       .integral(integrand, kTolerance));
    }
}

/// Whether means of the importance times a function over the density differ from integrals, by scrambled nets of random numbers.
/// \param warp    maps random numbers that should be uniform.
/// \param density of (technique, sample).
/// \tparam Sampled whose samples pose as those of Kind.
template <class Kind, class Sampled = Kind, class Warp, class Density>
bool means_are_rejected(const Warp& warp, const Density& density) {
    std::vector<double> p_values;
    for (const auto& light : lights_for<Kind>()) {
        const double expected = integral_of<Kind>(light);
        if (!(expected > 1e-4)) continue; // next to nothing is above the horizon
        const typename Sampled::template Technique<float> technique(light);
        const auto means = means_of([&](const auto& next) {
            const nusselt::Vec2<double> u = next();
            const auto in_float = [](double x) { return std::min(static_cast<float>(x), 1 - 0x1p-24f); };
            const auto s = technique.sample(warp(Random{in_float(u.x), in_float(u.y)}));
            if (!(s.pdf > 0)) return 0.0;
            const auto wi = nusselt::broadcast<long double>(s.wi);
            long double importance = std::max(wi.z, 0.0L);
            if constexpr (kHasLobe<Kind>) importance = ReferenceLobe(light.lobe).density(wi);
            return static_cast<double>(importance * test_function(wi) / density(technique, s));
        });
        // The slack covers rounding in float.
        p_values.push_back(student_t_test(means, expected, 5e-5 * expected));
        if (p_values.back() < kHopeless) return true;
    }
    return reject(p_values);
}

Random unwarped(const Random& u) { return u; }
constexpr auto kOwnDensity = [](const auto&, const auto& sample) { return sample.pdf; };

template <class Kind>
class RoundSamplesTest : public ::testing::Test {};

using Types = Instances<Join<TestedBy<StatisticsSuite, RoundKinds, RoundOnLobeKinds>, FineRoundKinds>, float>;
TYPED_TEST_SUITE(RoundSamplesTest, Types, InstanceNames);

TYPED_TEST(RoundSamplesTest, FollowTheirDensity) {
    EXPECT_FALSE(means_are_rejected<typename TypeParam::Kind>(unwarped, kOwnDensity));
}

/// How much stronger mutants have to be. Published methods with noise of their own hide weak ones.
template <class Kind>
constexpr float kStrength = 1;
template <>
inline constexpr float kStrength<SphereAreaKind> = 5;
template <>
inline constexpr float kStrength<DiskRejectionGamitoKind> = 25;
template <>
inline constexpr float kStrength<DiskProjectedRejectionGamitoKind> = 25;

TYPED_TEST(RoundSamplesTest, MutantsAreRejected) {
    using Kind = typename TypeParam::Kind;
    const float bend = 0.02f * kStrength<Kind>, gain = 1 + 0.002f * kStrength<Kind>;
    const auto bent = [bend](float x) { return x + bend * x * (1 - x); };
    EXPECT_TRUE(means_are_rejected<Kind>(
        [&](const Random& u) {
            return Random{bent(u.x), u.y};
        },
        kOwnDensity));
    EXPECT_TRUE(means_are_rejected<Kind>(
        [&](const Random& u) {
            return Random{u.x, bent(u.y)};
        },
        kOwnDensity));
    EXPECT_TRUE(means_are_rejected<Kind>(
        unwarped, [gain](const auto&, const auto& sample) { return gain * sample.pdf; }));
}

TEST(ClippedRoundMutants, UnclippedLobesPosingAsClippedAreRejected) {
    EXPECT_TRUE((means_are_rejected<SphereClippedLtcKind, SphereLtcKind>(unwarped, kOwnDensity)));
    EXPECT_TRUE((means_are_rejected<EllipseClippedLtcKind, EllipseLtcKind>(unwarped, kOwnDensity)));
}

} // namespace
} // namespace nusselt_test
