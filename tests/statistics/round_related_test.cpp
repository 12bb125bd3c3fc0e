/// Tests that means over samples of published methods for spheres and disks have no bias.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/related/cone_rejection_gamito.h>
#include <nusselt/related/cone_solid_angle_guillen.h>
#include <nusselt/related/sphere_area.h>
#include <nusselt/related/sphere_projected_solid_angle_peters.h>
#include <nusselt/related/sphere_projected_solid_angle_urena.h>
#include <nusselt/related/sphere_solid_angle_wang.h>

#include "cones/round_cases.h"
#include "hypothesis.h"

namespace nusselt_test {
namespace {

constexpr int kSamples = 20'000;

template <class Real>
using DiskGuillen = nusselt::ConeSolidAngleGuillen<Real, nusselt::Disk>;
template <class Real>
using DiskGamito = nusselt::ConeRejectionGamito<Real, nusselt::Disk>;
template <class Real>
using DiskProjectedGamito = nusselt::ConeProjectedRejectionGamito<Real, nusselt::Disk>;

/// Whether means of a cosine times a function over the density differ from integrals.
/// \param change of the density.
template <template <class> class Technique>
bool is_rejected(Shape shape, float change) {
    std::vector<double> p_values;
    RandomLights lights(41);
    UniformFloats random(9);
    const auto f = [](const Point& wi) { return std::max(wi.z, 0.0L) * (1 + wi.x / 2); };
    for (const Place place : {Place::ordinary, Place::at_horizon}) {
        for (int i = 0; i < 6; ++i) {
            const RoundLight light = lights(shape, place);
            const long double expected = VisiblePart(silhouette_of(light)).integral(f, 0, 1, 0, 1, 64);
            if (!(expected > 1e-3L)) continue;
            with_light<float>(light, [&](const auto& l) {
                if constexpr (std::is_constructible_v<Technique<float>, decltype(l)>) {
                    const Technique<float> technique(l);
                    MeanTest test;
                    for (int k = 0; k < kSamples; ++k) {
                        const float x = random();
                        const auto s = technique.sample({x, random()});
                        if (s.pdf > 0) test.add(f(nusselt::broadcast<long double>(s.wi)) / (change * s.pdf));
                    }
                    p_values.push_back(test.p_value(kSamples, expected, 1e-8L));
                }
            });
        }
    }
    return reject(p_values);
}

template <template <class> class Technique>
void expect_unbiased(Shape shape) {
    EXPECT_FALSE(is_rejected<Technique>(shape, 1));
    EXPECT_TRUE(is_rejected<Technique>(shape, 1.05f)) << "a density that is off by 5 % passes";
}

TEST(RoundRelatedTest, SpheresByAreaFollowTheirDensity) {
    expect_unbiased<nusselt::SphereArea>(Shape::sphere);
}
TEST(RoundRelatedTest, UniformConesFollowTheirDensity) {
    expect_unbiased<nusselt::SphereSolidAngleWang>(Shape::sphere);
}
TEST(RoundRelatedTest, ProjectedCapsByCutDisksFollowTheirDensity) {
    expect_unbiased<nusselt::SphereProjectedSolidAnglePeters>(Shape::sphere);
}
TEST(RoundRelatedTest, ProjectedCapsByLinesFollowTheirDensity) {
    expect_unbiased<nusselt::SphereProjectedSolidAngleUrena>(Shape::sphere);
}
TEST(RoundRelatedTest, SphericalEllipsesFollowTheirDensity) { expect_unbiased<DiskGuillen>(Shape::disk); }
TEST(RoundRelatedTest, RectanglesFollowTheirDensity) {
    expect_unbiased<DiskGamito>(Shape::disk);
    expect_unbiased<DiskProjectedGamito>(Shape::disk);
}

} // namespace
} // namespace nusselt_test
