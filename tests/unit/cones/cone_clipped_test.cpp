/// Tests of the clipped solid angle of spheres, disks, ellipses and ellipsoids: measures, densities and weights where
/// the horizon cuts them, and cases that have no rim of their own, such as a point inside.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped_solid_angle.h>

#include "cones/round_cases.h"
#include "cones/round_samples.h"

namespace nusselt_test {
namespace {

using nusselt::abs;
using nusselt::Disk;
using nusselt::Ellipsoid;
using nusselt::Sphere;
using nusselt::Vec2;

template <int Places = nusselt::kConePlaces, class T, template <class> class Light>
nusselt::ConeClippedSolidAngle<T, Light, Places> clipped(const Light<T>& light) {
    return nusselt::ConeClippedSolidAngle<T, Light, Places>(light);
}

bool is_visible(const RoundLight& light) {
    const Silhouette s = silhouette_of(light);
    return s.center.z > -std::hypot(s.u.z, s.v.z);
}

/// Calls f with a number of lights of each shape that are not wholly below the horizon.
template <class Function>
void for_each_light(Place place, int count, const Function& f) {
    RandomLights lights(11);
    for (int i = 0; i < count; ++i)
        for (const Shape shape : kShapes) {
            RoundLight light = lights(shape, place);
            while (!is_visible(light)) light = lights(shape, place);
            f(light);
        }
}

struct Case {
    const char* name;
    Place place;
    double spread;  ///< of weights around 1
    double measure; ///< relative error
};
// The interpolant is a polynomial but for wide cones, where it is linear between places.
constexpr Case kCases[] = {
    {"ordinary", Place::ordinary, 4e-3, 5e-5},   {"at horizon", Place::at_horizon, 4e-3, 1e-4},
    {"tiny", Place::tiny, 1e-3, 1e-5},           {"near", Place::near, 0.15, 2e-2},
    {"elongated", Place::elongated, 5e-3, 1e-4}, {"edge-on", Place::edge_on, 5e-3, 1e-4}};

TEST(ConeClippedSolidAngleTest, WeightsAreNearlyConstant) {
    for (const Case& c : kCases) {
        double least = 1, most = 1, worst = 0;
        for_each_light(c.place, 10, [&](const RoundLight& light) {
            const auto one = [](const Point&) { return 1.0L; };
            with_light<double>(light, [&](const auto& l) {
                const auto technique = clipped(l);
                const auto exact =
                    static_cast<double>(VisiblePart(silhouette_of(light)).integral(one, 0, 1, 0, 1, 128));
                ASSERT_GT(technique.measure(), 0) << c.name;
                worst = std::max(worst, std::fabs(technique.measure() / exact - 1));
                for (int i = 0; i < 256; ++i) {
                    const auto s = technique.sample(grid<double>(i, 16));
                    ASSERT_GT(s.pdf, 0);
                    ASSERT_GE(s.wi.z, 0);
                    least = std::min(least, 1 / (s.pdf * exact));
                    most = std::max(most, 1 / (s.pdf * exact));
                }
            });
        });
        EXPECT_LE(most - 1, c.spread) << c.name;
        EXPECT_GE(least - 1, -c.spread) << c.name;
        EXPECT_LE(worst, c.measure) << c.name;
    }
}

TEST(ConeClippedSolidAngleTest, WeightsOfWideConesAreNearlyConstantWithMorePlaces) {
    const auto spread = [](const auto& technique) {
        double largest = 0;
        EXPECT_GT(technique.measure(), 0);
        for (int i = 0; i < 256; ++i) {
            const double weight = 1 / (technique.sample(grid<double>(i, 16)).pdf * technique.measure());
            largest = std::max(largest, std::fabs(weight - 1));
        }
        return largest;
    };
    std::vector<double> coarse, fine;
    double worst = 0; // but of needles
    for (const Place place : {Place::near, Place::needle, Place::touching}) {
        for_each_light(place, 50, [&](const RoundLight& light) {
            with_light<double>(light, [&](const auto& l) { coarse.push_back(spread(clipped(l))); });
            with_light<double>(
                light, [&](const auto& l) { fine.push_back(spread(clipped<nusselt::kFineConePlaces>(l))); });
            if (place != Place::needle) worst = std::max(worst, fine.back());
        });
    }
    const auto most = [](std::vector<double>& spreads) {
        std::sort(spreads.begin(), spreads.end());
        return spreads[spreads.size() * 98 / 100];
    };
    constexpr double kTarget =
        0.005; // of all but needles of 1 : 100; cone_weights_test.cpp has more quantiles
    EXPECT_LE(worst, 0.02);
    EXPECT_LE(most(fine), kTarget);
    EXPECT_GT(most(coarse), kTarget);
}

/// The largest relative difference of densities and the Jacobian of the map from random numbers to directions.
/// \param change of the density.
template <int Places>
double jacobian_error(double change) {
    double worst = 0;
    for (const Place place :
         {Place::ordinary, Place::at_horizon, Place::near, Place::elongated, Place::touching}) {
        for_each_light(place, 10, [&](const RoundLight& light) {
            with_light<double>(light, [&](const auto& l) {
                const auto technique = clipped<Places>(l);
                ASSERT_GT(technique.measure(), 0);
                for (int i = 0; i < 16; ++i) {
                    const auto u = grid<double>(i, 4);
                    const double found = change * jacobian_at(technique, u) * technique.sample(u).pdf;
                    worst = std::max(worst, std::fabs(found - 1));
                }
            });
        });
    }
    return worst;
}

TEST(ConeClippedSolidAngleTest, DensitiesAreThoseOfTheMap) {
    constexpr double kDifferences = 3e-5; // of differences over 2e-5
    EXPECT_LE(jacobian_error<nusselt::kConePlaces>(1), kDifferences);
    EXPECT_GT(jacobian_error<nusselt::kConePlaces>(1.0001), kDifferences);
    EXPECT_LE(jacobian_error<nusselt::kFineConePlaces>(1), kDifferences);
    EXPECT_GT(jacobian_error<nusselt::kFineConePlaces>(1.0001), kDifferences);
}

/// The largest relative error of the mean of 1 / pdf for large disks so close to the point, and so flat to the surface,
/// that nearly all directions lead to them. All rays of their sweep almost reach the antipode of the pole.
template <class T>
double bias_of_wide_disks() {
    double worst = 0;
    for (const auto& [height, tilt] : {std::pair{3e-4, 4.5e-4}, {1e-4, 1.5e-4}, {1e-5, 1.5e-5}}) {
        const nusselt::Vec3<T> center{T(0.1), T(0.05), static_cast<T>(height)};
        const nusselt::Vec3<T> normal{static_cast<T>(tilt), static_cast<T>(0.3 * tilt), T(1)};
        const auto technique = clipped(Disk<T>{center, normalize(normal), T(1)});
        RandomLights jitter(61);
        double sum = 0;
        constexpr int kSide = 160;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double x = (i % kSide + jitter.uniform(0, 1)) / kSide;
            const double y = (i / kSide + jitter.uniform(0, 1)) / kSide;
            const auto pdf = technique.sample({static_cast<T>(x), static_cast<T>(y)}).pdf;
            sum += pdf > 0 ? 1 / static_cast<double>(pdf) : 0;
        }
        worst = std::max(worst, std::fabs(sum / (kSide * kSide) / static_cast<double>(2 * kPi) - 1));
    }
    return worst;
}

TEST(ConeClippedSolidAngleTest, DensitiesAreRightNextToTheAntipodeOfThePole) {
    constexpr double kError = 1e-3; // 4e-4 of the directions miss the first disk
    EXPECT_LE(bias_of_wide_disks<float>(), kError);
    EXPECT_LE(bias_of_wide_disks<double>(), kError);
}

/// No sample is below the surface, its point is on its ray, and it leads back to its random numbers.
template <int Places, class T>
void expect_valid(const RoundLight& light, T tolerance) {
    with_light<T>(light, [&](const auto& l) {
        const auto technique = clipped<Places>(l);
        ASSERT_GT(technique.measure(), 0);
        for (int i = 0; i < 64; ++i) {
            const auto u = grid<T>(i, 8);
            const auto s = technique.sample(u);
            ASSERT_GE(s.wi.z, 0);
            ASSERT_GE(s.p.z, 0);
            ASSERT_GT(s.pdf, 0);
            ASSERT_EQ(technique.pdf(s.wi), s.pdf);
            const auto back = technique.invert(s.wi);
            ASSERT_LE(abs(back.x - u.x), tolerance);
            ASSERT_LE(abs(back.y - u.y), tolerance);
        }
    });
}

template <int Places>
void expect_valid_in_every_precision() {
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near}) {
        for_each_light(place, 20, [](const RoundLight& light) {
            expect_valid<Places>(light, 2e-3f);
            expect_valid<Places>(light, 1e-9);
            expect_valid<Places>(light, 1e-9L);
        });
    }
}

TEST(ConeClippedSolidAngleTest, SamplesAreAboveTheSurfaceInEveryPrecision) {
    expect_valid_in_every_precision<nusselt::kConePlaces>();
    expect_valid_in_every_precision<nusselt::kFineConePlaces>();
}

/// Expects a measure [sr] and its inverse as the density of all samples.
template <class Technique>
void expect_uniform(const Technique& technique, double measure) {
    EXPECT_NEAR(technique.measure(), measure, 1e-5 * measure);
    for (int i = 0; i < 64; ++i) {
        const auto s = technique.sample(grid<float>(i, 8));
        EXPECT_NEAR(s.pdf * measure, 1, 1e-4);
        EXPECT_GE(s.wi.z, 0);
    }
}

TEST(ConeClippedSolidAngleTest, HalfOfAllDirectionsLeadToTheLightFromInsideOrFromItsSurface) {
    constexpr double kHalf = 2 * nusselt::kPi<double>;
    expect_uniform(clipped(Sphere<float>{{0, 0, 0}, 1}), kHalf);
    expect_uniform(clipped(Sphere<float>{{0.2f, -0.3f, 0.6f}, 1}), kHalf);
    expect_uniform(clipped(Sphere<float>{{0.2f, -0.3f, -0.6f}, 1}), kHalf);
    expect_uniform(clipped(Ellipsoid<float>{{0.1f, 0, 0.2f}, {{1, 0, 0}, {0, 0.5f, 0.1f}, {0, 0, 2}}}),
                   kHalf);
    expect_uniform(clipped(Sphere<float>{{0, 0, 1}, 1}), kHalf);
    expect_uniform(clipped(Sphere<float>{{1, 0, 0}, 1}), kHalf / 2);
    // In the plane of a disk, half of all directions meet it at no distance.
    expect_uniform(clipped(Disk<float>{{0, 0, 0}, {0, 0, 1}, 1}), kHalf);
    expect_uniform(clipped(Disk<float>{{0, 0, 0}, {1, 0, 0}, 1}), kHalf / 2);
}

TEST(ConeClippedSolidAngleTest, TouchingTheHorizonFromAboveClipsNothing) {
    const double sine = 1 / std::sqrt(10.0), cosine = std::sqrt(1 - sine * sine);
    const double cap = 2 * nusselt::kPi<double> * sine * sine / (1 + cosine);
    expect_uniform(clipped(Sphere<float>{{3, 0, 1}, 1}), cap);
    // The axis on the horizon: half of the cone.
    expect_uniform(clipped(Sphere<float>{{std::sqrt(10.0f), 0, 0}, 1}), cap / 2);
}

template <class Technique>
void expect_dark(const Technique& technique) {
    EXPECT_EQ(technique.measure(), 0);
    for (int i = 0; i < 16; ++i) {
        const auto s = technique.sample(grid<float>(i, 4));
        EXPECT_EQ(s.pdf, 0);
        EXPECT_EQ(s.wi.z, 1);
    }
}

TEST(ConeClippedSolidAngleTest, LightsBelowTheSurfaceAreDark) {
    expect_dark(clipped(Sphere<float>{{0.5f, 1, -2}, 1}));
    expect_dark(clipped(Sphere<float>{{0, 0, -1}, 1}));
    expect_dark(clipped(Disk<float>{{0.5f, 1, -2}, {0, 0, 1}, 1}));
    expect_dark(clipped(Disk<float>{{0.5f, 1, 2}, {0, 0, 1}, 0}));
}

} // namespace
} // namespace nusselt_test
