/// Published methods for spheres and disks with which benches compare.

#include <nusselt/related/cone_rejection_gamito.h>
#include <nusselt/related/cone_solid_angle_guillen.h>
#include <nusselt/related/sphere_area.h>
#include <nusselt/related/sphere_projected_solid_angle_peters.h>
#include <nusselt/related/sphere_projected_solid_angle_urena.h>
#include <nusselt/related/sphere_solid_angle_wang.h>
#include <nusselt/simd/pack.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "cones/round_cases.h"

namespace nusselt_test {
namespace {

using nusselt::Disk;
using nusselt::Sphere;
using nusselt::Vec2;

template <class T>
using DiskGuillen = nusselt::ConeSolidAngleGuillen<T, Disk>;
template <class T>
using DiskGamito = nusselt::ConeRejectionGamito<T, Disk>;
template <class T>
using DiskProjectedGamito = nusselt::ConeProjectedRejectionGamito<T, Disk>;

/// \tparam Technique of a number type.
template <template <class> class Technique, Shape kShape, bool kMisses>
struct Method {
    template <class T>
    using Type = Technique<T>;
    static constexpr Shape shape = kShape;
    static constexpr bool misses = kMisses; ///< whether samples without a density are a part of the method

    template <class T>
    static Technique<T> make(const RoundLight& light) {
        if constexpr (kShape == Shape::disk)
            return Technique<T>(Disk<T>{nusselt::broadcast<T>(light.center),
                                        normalize(nusselt::broadcast<T>(light.axis[2])),
                                        static_cast<T>(length(light.axis[0]))});
        else
            return Technique<T>(
                Sphere<T>{nusselt::broadcast<T>(light.center), static_cast<T>(length(light.axis[0]))});
    }
};

using Area = Method<nusselt::SphereArea, Shape::sphere, true>;
using Methods =
    ::testing::Types<Area, Method<nusselt::SphereSolidAngleWang, Shape::sphere, false>,
                     Method<nusselt::SphereProjectedSolidAnglePeters, Shape::sphere, false>,
                     Method<nusselt::SphereProjectedSolidAngleUrena, Shape::sphere, false>,
                     Method<DiskGuillen, Shape::disk, false>, Method<DiskGamito, Shape::disk, true>,
                     Method<DiskProjectedGamito, Shape::disk, true>>;

template <class Kind>
class RelatedRoundLightsTest : public ::testing::Test {};
TYPED_TEST_SUITE(RelatedRoundLightsTest, Methods);

std::vector<RoundLight> lights_of(Shape shape, int count) {
    std::vector<RoundLight> result;
    RandomLights random(31);
    for (const Place place : {Place::ordinary, Place::at_horizon})
        for (int i = 0; i < count; ++i) {
            RoundLight light = random(shape, place);
            // Enough is above the horizon that rounding does not decide.
            if (projected_solid_angle_of(silhouette_of(light)) > 1e-3L) result.push_back(light);
        }
    // Straight above, and touching the horizon.
    result.push_back({shape, {0, 0, 2}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    result.push_back({shape, {2, 0, 0.5}, {{0.5, 0, 0}, {0, 0.3, 0.4}, {0, 0.4, -0.3}}});
    return result;
}

template <class T>
std::vector<Vec2<T>> midpoints(int side) {
    std::vector<Vec2<T>> result;
    for (int i = 0; i < side * side; ++i)
        result.push_back({(static_cast<T>(i % side) + T(0.5)) / static_cast<T>(side),
                          (static_cast<T>(i / side) + T(0.5)) / static_cast<T>(side)});
    return result;
}

template <class Kind, class T>
void expect_contract(double tolerance) {
    for (const RoundLight& light : lights_of(Kind::shape, 20)) {
        const auto technique = Kind::template make<T>(light);
        for (const auto& u : midpoints<T>(13)) {
            const auto s = technique.sample(u);
            EXPECT_NEAR(length(s.wi), 1, tolerance);
            if (!(s.pdf > 0)) {
                EXPECT_TRUE(Kind::misses);
                continue;
            }
            // Next to the rim of a sphere, directions say little about points.
            const auto off = nusselt::broadcast<double>(s.p) - light.center;
            const double facing = -dot(off, nusselt::broadcast<double>(s.wi)) / length(light.axis[0]);
            if (std::is_same_v<Kind, Area> && facing < 0.3) continue;
            EXPECT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e3 * tolerance) << light.center.z;
            EXPECT_LE(length(cross(normalize(s.p), s.wi)), tolerance);
            const auto inverse = technique.invert(s.wi);
            EXPECT_NEAR(inverse.x, u.x, 1e3 * tolerance) << u.x << " " << light.center.z;
            EXPECT_NEAR(inverse.y, u.y, 1e3 * tolerance) << u.y << " " << light.center.z;
            if (Kind::shape == Shape::disk)
                EXPECT_NEAR(dot(off, normalize(light.axis[2])), 0, 100 * tolerance);
            else
                EXPECT_NEAR(length(off) / length(light.axis[0]), 1, 1e4 * tolerance);
        }
    }
}

TYPED_TEST(RelatedRoundLightsTest, InvertsSamplesAndHasTheirDensityAndPoint) {
    expect_contract<TypeParam, double>(1e-10);
    expect_contract<TypeParam, float>(5e-6);
}

TYPED_TEST(RelatedRoundLightsTest, LanesHaveTheBitsOfScalars) {
    using Lanes = nusselt::Pack<float, 4>;
    for (const RoundLight& light : lights_of(TypeParam::shape, 4)) {
        const auto single = TypeParam::template make<float>(light);
        const typename TypeParam::template Type<Lanes> all(single);
        for (const auto& u : midpoints<float>(5)) {
            const auto expected = single.sample(u);
            const auto found = all.sample({Lanes(u.x), Lanes(u.y)});
            EXPECT_EQ(found.pdf.lane(2), expected.pdf);
            EXPECT_EQ(found.wi.x.lane(3), expected.wi.x);
        }
    }
}

TYPED_TEST(RelatedRoundLightsTest, IsDarkWithoutLight) {
    const RoundLight none{TypeParam::shape, {1, 2, 3}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}};
    // Inside of a sphere, or in the plane of a disk.
    const bool is_disk = TypeParam::shape == Shape::disk;
    const RoundLight inside{TypeParam::shape, {is_disk ? 2.0 : 0.5, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const RoundLight& light : {none, inside}) {
        const auto technique = TypeParam::template make<float>(light);
        EXPECT_EQ(technique.measure(), 0);
        const auto s = technique.sample({0.25f, 0.625f});
        EXPECT_EQ(s.pdf, 0);
        EXPECT_LE(length(s.wi), 1 + 1e-5f) << "not finite";
    }
}

/// The largest error of the mean of a function with a cosine over the density, relative to its integral.
/// \param density of (technique, sample).
template <class Kind, class Density>
double estimate_error(const Density& density) {
    const auto f = [](const Point& wi) { return std::max(wi.z, 0.0L) * (1 + wi.x / 2); };
    double worst = 0;
    for (const RoundLight& light : lights_of(Kind::shape, 3)) {
        const auto technique = Kind::template make<double>(light);
        const auto points = midpoints<double>(300);
        long double sum = 0;
        for (const auto& u : points) {
            const auto s = technique.sample(u);
            if (s.pdf > 0) sum += f(nusselt::broadcast<long double>(s.wi)) / density(technique, s);
        }
        const long double expected = VisiblePart(silhouette_of(light)).integral(f, 0, 1, 0, 1, 64);
        const long double mean = sum / static_cast<long double>(points.size());
        worst = std::max(worst, static_cast<double>(std::fabs(mean / expected - 1)));
    }
    return worst;
}

/// The midpoint rule errs along outlines in the unit square.
constexpr double kEstimateBudget = 4e-3;

TYPED_TEST(RelatedRoundLightsTest, DensityIntegratesFunctionsOverTheLight) {
    EXPECT_LE(estimate_error<TypeParam>([](const auto&, const auto& s) { return s.pdf; }), kEstimateBudget);
}

TYPED_TEST(RelatedRoundLightsTest, DensitiesOffByOnePercentAreRejected) {
    EXPECT_GT(estimate_error<TypeParam>([](const auto&, const auto& s) { return 1.01 * s.pdf; }),
              kEstimateBudget);
}

TEST(RelatedRoundLightsTest, UniformConesHaveTheSolidAnglesOfFarAndNearSpheres) {
    for (const double distance : {1.0001, 1.5, 3.0, 1e3, 1e6}) {
        const Sphere<double> sphere{{0.6 * distance, 0, 0.8 * distance}, 1};
        const double sine = 1 / distance, cosine = std::sqrt((1 - sine) * (1 + sine));
        const double expected = 2 * static_cast<double>(kPi) * sine * sine / (1 + cosine);
        EXPECT_NEAR(nusselt::SphereSolidAngleWang<double>(sphere).measure() / expected, 1, 1e-12);
        const Sphere<float> single{nusselt::broadcast<float>(sphere.center), 1};
        EXPECT_NEAR(nusselt::SphereSolidAngleWang<float>(single).measure() / expected, 1,
                    distance < 1.001 ? 2e-4 : 1e-6);
        EXPECT_NEAR((nusselt::ConeSolidAngle<float, Sphere>(single).measure() / expected), 1,
                    distance < 1.001 ? 2e-4 : 1e-6);
    }
}

TEST(RelatedRoundLightsTest, MeasuresAreContourIntegrals) {
    for (const RoundLight& light : lights_of(Shape::sphere, 40)) {
        const auto expected = static_cast<double>(projected_solid_angle_of(silhouette_of(light)));
        const Sphere<double> sphere{light.center, length(light.axis[0])};
        EXPECT_NEAR(nusselt::SphereProjectedSolidAngleUrena<double>(sphere).measure() / expected, 1, 1e-10);
        const double published = nusselt::SphereProjectedSolidAnglePeters<double>(sphere).measure();
        // The measure is that of a scaled segment where the centre is below the horizon.
        EXPECT_NEAR(published / expected, 1, light.center.z > 0 ? 1e-10 : 0.25);
    }
}

} // namespace
} // namespace nusselt_test
