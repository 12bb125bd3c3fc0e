/// Tests of sampling of spheres, disks, ellipses and ellipsoids by projected solid angle: integrals, densities, inverses, points.

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "cones/round_cases.h"
#include "cones/round_samples.h"

namespace nusselt_test {
namespace {

using nusselt::ConeProjectedSolidAngle;
using nusselt::Disk;
using nusselt::Ellipse;
using nusselt::Ellipsoid;
using nusselt::Sphere;
using nusselt::Vec2;
using nusselt::Vec3;

template <class T, template <class> class Light>
ConeProjectedSolidAngle<T, Light> technique_for(const Light<T>& light) {
    return ConeProjectedSolidAngle<T, Light>(light);
}

std::string name_of(const RoundLight& light, Place place) {
    return "shape " + std::to_string(static_cast<int>(light.shape)) + " place " +
           std::to_string(static_cast<int>(place)) + " center " + std::to_string(light.center.x) + " " +
           std::to_string(light.center.y) + " " + std::to_string(light.center.z);
}

template <class Function>
void for_each_light(int count, const Function& f) {
    RandomLights lights(3);
    for (const Place place : kPlaces)
        for (const Shape shape : kShapes)
            for (int i = 0; i < count; ++i) f(lights(shape, place), place);
}

/// Relative errors of the measure, by the place of the light. Where the horizon cuts little of a light or nearly all of it, a
/// rounding of the normal moves the horizon: the bound holds for all lights, the usual error is far below.
struct Budget {
    double usual, largest;
};
template <class T>
Budget budget(Place place) {
    const bool is_float = std::is_same_v<T, float>;
    switch (place) {
    case Place::near:
    case Place::elongated:
        return is_float ? Budget{2e-4, 2e-2} : Budget{1e-6, 2e-2};
    case Place::edge_on:
        return is_float ? Budget{2e-3, 5e-2} : Budget{1e-10, 1e-6};
    case Place::tiny:
        return is_float ? Budget{1e-4, 5e-2} : Budget{1e-7, 1e-5};
    default:
        return is_float ? Budget{1e-5, 2e-2} : Budget{1e-10, 1e-5};
    }
}

template <class T>
void expect_measures() {
    for (const Place place : kPlaces) {
        std::vector<double> errors;
        RandomLights lights(5);
        for (const Shape shape : kShapes) {
            for (int i = 0; i < 30; ++i) {
                const RoundLight light = lights(shape, place);
                const auto expected = static_cast<double>(projected_solid_angle_of(silhouette_of(light)));
                const auto found = with_light<T>(
                    light, [](const auto& l) { return static_cast<double>(technique_for(l).measure()); });
                // Rounding may move the last sliver of a light below the horizon.
                const double whole = dot(light.axis[0], light.axis[0]) / dot(light.center, light.center);
                if (expected < 1e-6 * whole) continue;
                errors.push_back(std::fabs(found / expected - 1));
                EXPECT_LE(errors.back(), budget<T>(place).largest) << name_of(light, place);
            }
        }
        ASSERT_GT(errors.size(), 50u);
        std::sort(errors.begin(), errors.end());
        EXPECT_LE(errors[errors.size() * 9 / 10], budget<T>(place).usual) << static_cast<int>(place);
    }
}

TEST(ConeProjectedSolidAngleTest, MeasuresAreContourIntegrals) {
    expect_measures<float>();
    expect_measures<double>();
}

/// The mean of a smooth function over the density is its integral for any light, also where the interpolant is coarse.
TEST(ConeProjectedSolidAngleTest, EstimatesAreUnbiasedAndNearlyConstant) {
    for_each_light(6, [](const RoundLight& light, Place place) {
        const auto expected = static_cast<double>(projected_solid_angle_of(silhouette_of(light)));
        with_light<double>(light, [&](const auto& l) {
            const auto technique = technique_for(l);
            constexpr int kSide = 96;
            double sum = 0, largest = 0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const auto s = technique.sample({(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide});
                if (!(s.pdf > 0)) continue;
                const double weight = s.wi.z / s.pdf;
                sum += weight / (kSide * kSide);
                largest = std::max(largest, weight);
            }
            if (expected == 0) {
                EXPECT_EQ(sum, 0) << name_of(light, place);
                return;
            }
            const bool is_coarse = place == Place::near || place == Place::elongated;
            // The reference loses digits of tiny lights.
            const double tolerance = is_coarse ? 2e-3 : place == Place::tiny ? 2e-5 : 1e-6;
            EXPECT_NEAR(sum / expected, 1, tolerance) << name_of(light, place);
            EXPECT_LE(largest / expected, is_coarse ? 1.6 : 1.001) << name_of(light, place);
        });
    });
}

template <class T>
void expect_inverses(double tolerance) {
    for_each_light(20, [&](const RoundLight& light, Place place) {
        // A unit vector does not tell directions to a tiny light apart.
        if (place == Place::tiny) return;
        with_light<T>(light, [&](const auto& l) {
            const auto technique = technique_for(l);
            if (!(technique.measure() > T(0.001))) return;
            for (int i = 0; i < 16; ++i) {
                const Vec2<T> u{(static_cast<T>(i % 4) + T(0.5)) / 4, (static_cast<T>(i / 4) + T(0.5)) / 4};
                const auto s = technique.sample(u);
                EXPECT_EQ(s.pdf, technique.pdf(s.wi));
                const auto inverse = technique.invert(s.wi);
                EXPECT_NEAR(static_cast<double>(inverse.x), static_cast<double>(u.x), tolerance)
                    << name_of(light, place);
                EXPECT_NEAR(static_cast<double>(inverse.y), static_cast<double>(u.y), tolerance)
                    << name_of(light, place);
            }
        });
    });
}

/// Edge-on lights are 1e-4 wide.
TEST(ConeProjectedSolidAngleTest, InversesLeadBack) {
    expect_inverses<float>(2e-2);
    expect_inverses<double>(5e-8);
    expect_inverses<long double>(5e-8);
}

TEST(ConeProjectedSolidAngleTest, DensitiesAreReciprocalsOfJacobians) {
    for_each_light(10, [](const RoundLight& light, Place place) {
        if (place == Place::tiny || place == Place::edge_on) return;
        with_light<double>(light, [&](const auto& l) {
            const auto technique = technique_for(l);
            if (!(technique.measure() > 1e-3)) return;
            for (const double x : {0.2, 0.45, 0.8}) {
                const double y = 0.9 - 0.7 * x;
                const double jacobian = jacobian_at(technique, {x, y});
                // Differences across kinks of a coarse interpolant are wrong by a kink times the step.
                EXPECT_NEAR(technique.sample({x, y}).pdf * jacobian, 1, 2e-3) << name_of(light, place);
            }
        });
    });
}

TEST(ConeProjectedSolidAngleTest, SamplesAreDirectionsToPointsOfTheLight) {
    for_each_light(20, [](const RoundLight& light, Place place) {
        with_light<float>(light, [&](const auto& l) {
            const auto technique = technique_for(l);
            if (!(technique.measure() > 0)) return;
            for (int i = 0; i < 16; ++i) {
                const auto s = technique.sample(
                    {(static_cast<float>(i % 4) + 0.5f) / 4, (static_cast<float>(i / 4) + 0.5f) / 4});
                if (!(s.pdf > 0)) continue;
                EXPECT_GE(s.wi.z, 0);
                EXPECT_NEAR(dot(s.wi, s.wi), 1, 1e-5f) << name_of(light, place);
                EXPECT_LE(length(cross(s.wi, s.p)), 1e-5f * length(s.p)) << name_of(light, place);
                // Rounding of the distance of 40 m is 2e-2 of a tiny light; edge-on, ellipses turn by the rounding over the sine.
                const double slack = place == Place::tiny                                   ? 0.1
                                     : place == Place::elongated || place == Place::edge_on ? 1e-2
                                                                                            : 2e-3;
                EXPECT_LE(distance_from(light, nusselt::broadcast<double>(s.p)), slack)
                    << name_of(light, place);
            }
        });
    });
}

TEST(ConeProjectedSolidAngleTest, KnowsTheTextbook) {
    // A disk above the point, a sphere above the horizon, and the hemisphere.
    const Disk<double> disk{{0, 0, 2}, {0, 0, 1}, 1.5};
    EXPECT_NEAR(technique_for(disk).measure(), kPi * 2.25 / (2.25 + 4), 1e-14);
    const Sphere<double> sphere{{0.6, 0, 1.6}, 0.5};
    const double squared = 0.36 + 1.6 * 1.6;
    EXPECT_NEAR(technique_for(sphere).measure(), kPi * 0.25 / squared * 1.6 / std::sqrt(squared), 1e-14);
    // Half of a sphere at the horizon, whose tangent cone has the half-angle alpha: alpha - sin(alpha) cos(alpha).
    const double alpha = std::asin(0.5 / 2);
    EXPECT_NEAR(technique_for(Sphere<double>{{2, 0, 0}, 0.5}).measure(),
                alpha - std::sin(alpha) * std::cos(alpha), 1e-13);
    EXPECT_NEAR(technique_for(Sphere<double>{{0.1, 0.2, -0.3}, 1}).measure(), static_cast<double>(kPi),
                1e-14);
}

TEST(ConeProjectedSolidAngleTest, FromInsideAllDirectionsMeetTheSurface) {
    const RoundLight light{Shape::ellipsoid, {0.3, -0.4, -0.2}, {{2, 0, 0}, {0, 1, 0.5}, {0, -0.75, 1.5}}};
    with_light<float>(light, [&](const auto& l) {
        const auto technique = technique_for(l);
        EXPECT_NEAR(technique.measure(), static_cast<float>(kPi), 1e-6f);
        for (int i = 0; i < 64; ++i) {
            const auto s = technique.sample(
                {(static_cast<float>(i % 8) + 0.5f) / 8, (static_cast<float>(i / 8) + 0.5f) / 8});
            EXPECT_NEAR(s.pdf, s.wi.z / static_cast<float>(kPi), 1e-6f);
            EXPECT_LE(distance_from(light, nusselt::broadcast<double>(s.p)), 1e-5);
        }
    });
}

template <class Light>
void expect_dark(const Light& light) {
    const auto technique = technique_for(light);
    EXPECT_EQ(technique.measure(), 0);
    const auto s = technique.sample({0.3f, 0.6f});
    EXPECT_EQ(s.pdf, 0);
    EXPECT_EQ(dot(s.wi, s.wi), 1);
    EXPECT_EQ(technique.pdf({0, 0, 1}), 0);
}

TEST(ConeProjectedSolidAngleTest, SamplesOfCircularConesDoNotDependOnTheirAxes) {
    using nusselt::WholeCone;
    // Without the start of the turn at the x-axis, the samples would turn with the axes, by up to the width of the light.
    const Vec3<float> axis = normalize(Vec3<float>{0.3f, -0.2f, 1.0f});
    const auto frame = nusselt::Frame<float>::from_normal(axis);
    for (const float tangent : {1e-4f, 0.2f, 0.7f}) {
        for (int i = 0; i < 64; ++i) {
            const Vec2<float> u{(static_cast<float>(i % 8) + 0.5f) / 8,
                                (static_cast<float>(i / 8) + 0.5f) / 8};
            const auto sample_of = [&](float angle) {
                nusselt::EllipticCone<float> cone{};
                cone.e1 = std::cos(angle) * frame.t + std::sin(angle) * frame.b;
                cone.e2 = std::cos(angle) * frame.b - std::sin(angle) * frame.t;
                cone.e3 = axis;
                cone.a = cone.b = tangent;
                cone.c = 1;
                cone.is_visible = true;
                return WholeCone<float, 2>(cone);
            };
            const Vec3<float> expected = sample_of(0).sample(u).wi;
            for (const float angle : {0.1f, 1.0f, 2.0f, 3.0f, 4.5f}) {
                const auto cone = sample_of(angle);
                const Vec3<float> wi = cone.sample(u).wi;
                EXPECT_LT(length(wi - expected), 1e-5f * tangent + 3e-7f) << tangent << " " << angle;
                if (tangent < 0.1f) continue;
                const Vec2<float> inverse = cone.invert(wi);
                EXPECT_NEAR(inverse.x, u.x, 1e-5f);
                EXPECT_NEAR(inverse.y, u.y, 1e-5f);
            }
        }
    }
}

TEST(ConeProjectedSolidAngleTest, LightsWithoutExtentAreDark) {
    expect_dark(Disk<float>{{0, 1, 1}, {0, 0, 1}, 0});
    expect_dark(Disk<float>{{0, 1, 1}, {1, 0, 0}, 0.25f}); // edge-on
    expect_dark(Disk<float>{{0, 1, -1}, {0, 0, 1}, 0.5f}); // below the surface
    expect_dark(Sphere<float>{{0, 1, 1}, 0});
    expect_dark(Sphere<float>{{0, 0, -2}, 1});
    expect_dark(Ellipse<float>{{0, 1, 1}, {0, 0, 0}, {1, 0, 0}});
    expect_dark(Ellipsoid<float>{{0, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}});
}

/// The random numbers of samples in float, by the inverse in double.
TEST(ConeProjectedSolidAngleTest, SamplesOfFloatHaveSmallBackwardErrors) {
    for (const Place place : {Place::ordinary, Place::at_horizon}) {
        RandomLights lights(13);
        std::vector<double> errors;
        for (int i = 0; i < 2000; ++i) {
            const RoundLight light = lights(kShapes[i % 4], place);
            with_light<double>(light, [&](const auto& precise) {
                const auto reference = technique_for(precise);
                // Unit vectors of float do not resolve lights that are seen edge-on.
                if (!(reference.measure() > 1e-2)) return;
                with_light<float>(light, [&](const auto& l) {
                    const auto technique = technique_for(l);
                    for (int k = 0; k < 4; ++k) {
                        const Vec2<float> u{static_cast<float>(lights.uniform(0, 1)),
                                            static_cast<float>(lights.uniform(0, 1))};
                        const auto wi = nusselt::broadcast<double>(technique.sample(u).wi);
                        const auto found = reference.invert(wi);
                        // The basis of float is another one for symmetric cones.
                        if (light.shape == Shape::sphere || light.shape == Shape::disk)
                            errors.push_back(std::fabs(found.y - static_cast<double>(u.y)));
                        else
                            errors.push_back(std::max(std::fabs(found.x - static_cast<double>(u.x)),
                                                      std::fabs(found.y - static_cast<double>(u.y))));
                    }
                });
            });
        }
        ASSERT_GT(errors.size(), 2000u);
        std::sort(errors.begin(), errors.end());
        // Measured: 3.8e-6 and 1.9e-5.
        EXPECT_LE(errors[errors.size() * 999 / 1000], 1e-5);
        EXPECT_LE(errors.back(), 1e-4);
    }
}

/// The ratio of the sweep and its interpolant is part of the density.
TEST(ConeProjectedSolidAngleTest, InterpolantsAreExactForOrdinaryLights) {
    RandomLights lights(11);
    int cut = 0;
    std::vector<double> ratios;
    for (int i = 0; i < 400; ++i) {
        const RoundLight light = lights(kShapes[i % 4], Place::at_horizon);
        with_light<double>(light, [&](const auto& l) {
            const auto technique = technique_for(l);
            if (!(technique.measure() > 0)) return;
            ++cut;
            for (int k = 0; k < 16; ++k) {
                const auto s = technique.sample({(k % 4 + 0.5) / 4, (k / 4 + 0.5) / 4});
                ratios.push_back(std::fabs(s.wi.z / s.pdf / technique.measure() - 1));
            }
        });
    }
    EXPECT_GT(cut, 200);
    std::sort(ratios.begin(), ratios.end());
    EXPECT_LE(ratios[ratios.size() * 99 / 100], 1e-4);
    EXPECT_LE(ratios.back(), 1e-2);
}

} // namespace
} // namespace nusselt_test
