/// Tests of spheres, disks, ellipses and ellipsoids by solid angle and by lobes, and of analytic shading with them.

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include <nusselt/cones/cone_clipped_ltc.h>
#include <nusselt/cones/cone_clipped_solid_angle.h>
#include <nusselt/cones/cone_shading.h>

#include "cones/lobe_part.h"
#include "cones/round_cases.h"
#include "cones/round_samples.h"

namespace nusselt_test {
namespace {

using nusselt::ConeLtc;
using nusselt::ConeProjectedSolidAngle;
using nusselt::ConeSolidAngle;
using nusselt::Ltc;
using nusselt::LtcCoefficients;
using nusselt::Vec2;

template <class T, template <class> class Light>
ConeSolidAngle<T, Light> by_solid_angle(const Light<T>& light) {
    return ConeSolidAngle<T, Light>(light);
}
template <class T, template <class> class Light>
ConeLtc<T, Light> by_lobe(const Light<T>& light, const Ltc<T>& ltc) {
    return ConeLtc<T, Light>(light, ltc);
}

template <class Function>
void for_each_light(int count, const Function& f) {
    RandomLights lights(7);
    for (const Place place : {Place::ordinary, Place::at_horizon, Place::near, Place::elongated})
        for (const Shape shape : kShapes)
            for (int i = 0; i < count; ++i) f(lights(shape, place), place);
}

/// The solid angle as the flux of 1 / (1 + w.z) curl: the area between the rim and the zenith, for cones that have not the nadir.
/// 1 - cos integrated over the azimuth.
long double solid_angle_of(const Silhouette& s) {
    // Around the axis of the ellipse's centre, the cone is star-shaped.
    const Point axis = normalize(s.center);
    const Point a =
        normalize(std::fabs(axis.z) < 0.7L ? cross(axis, Point{0, 0, 1}) : cross(axis, Point{1, 0, 0}));
    const Point b = cross(axis, a);
    constexpr int kCount = 5000;
    long double sum = 0;
    for (int i = 0; i < kCount; ++i) {
        const long double angle = 2 * kPi * (i + 0.5L) / kCount;
        const Point q = s.center + std::cos(angle) * s.u + std::sin(angle) * s.v;
        const Point slope = std::cos(angle) * s.v - std::sin(angle) * s.u;
        const long double x = dot(q, a), y = dot(q, b), z = dot(q, axis);
        const long double turn = (x * dot(slope, b) - y * dot(slope, a)) / (x * x + y * y);
        sum += (1 - z / length(q)) * turn * 2 * kPi / kCount;
    }
    return std::fabs(sum);
}

TEST(ConeSolidAngleTest, EstimatesAreUnbiasedAndNearlyConstant) {
    for_each_light(5, [](const RoundLight& light, Place place) {
        const auto expected = static_cast<double>(solid_angle_of(silhouette_of(light)));
        with_light<double>(light, [&](const auto& l) {
            const auto technique = by_solid_angle(l);
            constexpr int kSide = 64;
            double sum = 0, least = 1e9, largest = 0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const Vec2<double> u{(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide};
                const auto s = technique.sample(u);
                ASSERT_GT(s.pdf, 0);
                sum += 1 / s.pdf / (kSide * kSide);
                least = std::min(least, 1 / s.pdf);
                largest = std::max(largest, 1 / s.pdf);
                if (i % 37 == 0) {
                    const auto inverse = technique.invert(s.wi);
                    EXPECT_NEAR(inverse.x, u.x, 1e-9);
                    EXPECT_NEAR(inverse.y, u.y, 1e-9);
                }
            }
            const bool is_coarse = place == Place::near || place == Place::elongated;
            const double tolerance = is_coarse ? 1e-4 : 2e-5;
            EXPECT_NEAR(sum / expected, 1, tolerance) << static_cast<int>(place);
            EXPECT_GE(least / expected, 0.99);
            EXPECT_LE(largest / expected, 1.015);
        });
    });
}

TEST(ConeSolidAngleTest, SpheresHaveConstantDensities) {
    const nusselt::Sphere<float> sphere{{0.5f, -2, 1}, 0.75f};
    const auto technique = by_solid_angle(sphere);
    const double cosine = std::sqrt(1 - 0.75 * 0.75 / 5.25);
    EXPECT_NEAR(technique.measure(), 2 * static_cast<double>(kPi) * (1 - cosine), 1e-6);
    EXPECT_NEAR(technique.sample({0.1f, 0.9f}).pdf * technique.measure(), 1, 1e-6);
    // From inside, all of the sphere of directions.
    const nusselt::Sphere<double> around{{0.25, 0.5, -0.25}, 1};
    const auto inside = by_solid_angle(around);
    EXPECT_NEAR(inside.measure(), 4 * static_cast<double>(kPi), 1e-12);
    for (const double y : {0.1, 0.4, 0.8}) {
        const auto s = inside.sample({0.3, y});
        EXPECT_NEAR(length(s.p - around.center), 1, 1e-12);
        EXPECT_NEAR(inside.invert(s.wi).y, y, 1e-12);
        EXPECT_NEAR(inside.invert(s.wi).x, 0.3, 1e-12);
    }
}

const LtcCoefficients<double> kLobes[] = {
    {1, 0, 1, 0, 1, 1}, {0.35, -0.08, 0.4, 0.05, 0.9, 1}, {0.06, -0.3, 0.08, 0.4, 0.7, 1}};

/// The silhouette in cosine space.
Silhouette image_of(const Silhouette& s, const LtcCoefficients<double>& c) {
    const auto map = [&](const Point& p) {
        return Point{c.m00 * p.x + c.m02 * p.z, c.m11 * p.y, c.m20 * p.x + c.m22 * p.z};
    };
    return {map(s.center), map(s.u), map(s.v)};
}

TEST(ConeLtcTest, EstimatesAndShadingAreContourIntegralsInCosineSpace) {
    for_each_light(4, [](const RoundLight& light, Place place) {
        for (const auto& lobe : kLobes) {
            const Ltc<double> ltc(lobe);
            const auto expected =
                static_cast<double>(projected_solid_angle_of(image_of(silhouette_of(light), lobe)) / kPi);
            with_light<double>(light, [&](const auto& l) {
                const auto technique = by_lobe(l, ltc);
                const double shading = round_lobe_integral(l, ltc);
                if (expected < 1e-6) return;
                constexpr int kSide = 64;
                double sum = 0;
                for (int i = 0; i < kSide * kSide; ++i) {
                    const Vec2<double> u{(i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide};
                    const auto s = technique.sample(u);
                    if (s.pdf > 0) sum += ltc.density(s.wi) / s.pdf / (kSide * kSide);
                    EXPECT_EQ(s.pdf, technique.pdf(s.wi));
                    if (i % 67 == 0) {
                        const auto inverse = technique.invert(s.wi);
                        EXPECT_NEAR(inverse.x, u.x, 1e-6);
                        EXPECT_NEAR(inverse.y, u.y, 1e-6);
                    }
                }
                const bool is_coarse = place == Place::near || place == Place::elongated;
                EXPECT_NEAR(sum / expected, 1, is_coarse ? 4e-3 : 1e-4);
                EXPECT_NEAR(shading / expected, 1, is_coarse ? 4e-2 : 1e-4);
            });
        }
    });
}

TEST(ConeLtcTest, PointsLieOnTheLightAndAlongDirections) {
    for_each_light(6, [](const RoundLight& light, Place) {
        for (const auto& lobe : kLobes) {
            with_light<float>(light, [&](const auto& l) {
                const auto technique =
                    by_lobe(l, Ltc<float>({static_cast<float>(lobe.m00), static_cast<float>(lobe.m02),
                                           static_cast<float>(lobe.m11), static_cast<float>(lobe.m20),
                                           static_cast<float>(lobe.m22), 1}));
                for (int i = 0; i < 9; ++i) {
                    const auto s = technique.sample(
                        {(static_cast<float>(i % 3) + 0.5f) / 3, (static_cast<float>(i / 3) + 0.5f) / 3});
                    if (!(s.pdf > 0)) continue;
                    double coordinate[3];
                    const auto p = nusselt::broadcast<double>(s.p);
                    for (int k = 0; k < 3; ++k)
                        coordinate[k] =
                            dot(p - light.center, light.axis[k]) / dot(light.axis[k], light.axis[k]);
                    const auto [x, y, z] = coordinate;
                    const bool is_solid = light.shape == Shape::sphere || light.shape == Shape::ellipsoid;
                    EXPECT_LE(is_solid ? std::fabs(std::sqrt(x * x + y * y + z * z) - 1) : std::fabs(z),
                              2e-2);
                    EXPECT_LE(length(cross(s.wi, s.p)), 1e-5f * length(s.p));
                }
            });
        }
    });
}

/// The measure is one, and so are all weights.
template <class T, template <class> class Light>
void expect_filled(const Light<T>& light, const LtcCoefficients<long double>& coefficients) {
    const auto ltc = lobe_of<T>(coefficients);
    const auto technique = by_lobe(light, ltc);
    EXPECT_NEAR(technique.measure(), 1, 1e-3);
    for (int i = 0; i < 256; ++i) {
        const auto s = technique.sample(grid<T>(i, 16));
        ASSERT_GT(s.pdf, 0);
        EXPECT_NEAR(ltc.density(s.wi) / s.pdf, 1, 0.05);
    }
}

/// In cosine space, such lights are nearly the hemisphere, and all rays of the sweep almost reach the antipode of the pole.
template <class T>
void expect_filled_lobes() {
    const auto v = [](double x, double y, double z) {
        return nusselt::Vec3<T>{static_cast<T>(x), static_cast<T>(y), static_cast<T>(z)};
    };
    expect_filled(nusselt::Sphere<T>{v(0.0197156139, -0.000118859509, 1.00999999), 1},
                  tilted_lobe(0.3L, 2e-4L, 1, 0));
    expect_filled(nusselt::Sphere<T>{v(0, 0.5, 1), 1}, tilted_lobe(0, 2e-4L, 1, 0));
    // Not circular there, so that the ray closest to the antipode is not the highest one.
    const nusselt::Disk<T> disk{v(0, -0.4, 1), normalize(v(0.644217687, 0, 0.764842187)), 3};
    for (const long double width : {2e-4L, 2e-3L, 2e-2L}) expect_filled(disk, tilted_lobe(0, width, 1, 0));
}

TEST(ConeLtcTest, NarrowLobesThatALightFillsHaveConstantWeights) {
    expect_filled_lobes<float>();
    expect_filled_lobes<double>();
}

TEST(ConeLtcTest, WithoutATransformItIsTheCosine) {
    const nusselt::Disk<double> disk{{0.3, 0.9, 0.2}, normalize(nusselt::Vec3<double>{1, 2, 2}), 0.5};
    const auto lobe = by_lobe(disk, Ltc<double>(kLobes[0]));
    const ConeProjectedSolidAngle<double, nusselt::Disk> cosine(disk);
    EXPECT_NEAR(lobe.measure() * static_cast<double>(kPi) / cosine.measure(), 1, 1e-7);
    EXPECT_NEAR(round_diffuse_integral(disk) / lobe.measure(), 1, 1e-7);
    const auto s = lobe.sample({0.3, 0.7});
    EXPECT_NEAR(s.pdf / cosine.pdf(s.wi), 1, 1e-6);
}

/// A disk that fills the half-space above the surface but for a tilt, which rounding may cause.
template <class T>
void expect_lit_half_spaces() {
    constexpr T kEpsilon = std::numeric_limits<T>::epsilon();
    const Ltc<T> diffuse(LtcCoefficients<T>{1, 0, 1, 0, 1, 1});
    for (const T height : {T(0), T(0.01) * kEpsilon, kEpsilon, 4 * kEpsilon, 20 * kEpsilon}) {
        for (const T tilt :
             {T(0), T(0.1) * kEpsilon, kEpsilon, 3 * kEpsilon, 7 * kEpsilon, 9 * kEpsilon, 50 * kEpsilon}) {
            const nusselt::Disk<T> disk{
                {T(0.3), T(0.2), height}, normalize(nusselt::Vec3<T>{tilt, -tilt / 2, 1}), 2};
            const auto expect_lit = [&](const auto& technique, T measure) {
                EXPECT_NEAR(technique.measure() / measure, 1, T(1e-3)) << height << " " << tilt;
                EXPECT_LE(technique.measure(), measure * (1 + 4 * kEpsilon));
                const auto s = technique.sample({T(0.3), T(0.7)});
                EXPECT_GT(s.pdf, 0) << height << " " << tilt;
                EXPECT_GT(s.wi.z, 0);
            };
            expect_lit(ConeProjectedSolidAngle<T, nusselt::Disk>(disk), static_cast<T>(kPi));
            expect_lit(nusselt::ConeClippedSolidAngle<T, nusselt::Disk>(disk), static_cast<T>(2 * kPi));
            expect_lit(ConeLtc<T, nusselt::Disk>(disk, diffuse), 1);
            expect_lit(nusselt::ConeClippedLtc<T, nusselt::Disk>(disk, diffuse), 1);
        }
    }
}

/// Integrals of a function over the light, and of its products with x^2 and y^2, by stratified samples. The products
/// tell whether samples cover the light.
template <class T, class Technique, class Integrand>
nusselt::Vec3<T> moments(const Technique& technique, const Integrand& integrand) {
    constexpr int kRows = 32;
    nusselt::Vec3<T> sum{0, 0, 0};
    for (int i = 0; i < kRows * kRows; ++i) {
        const nusselt::Vec2<T> u{(T(i % kRows) + T(0.5)) / kRows, (T(i / kRows) + T(0.5)) / kRows};
        const auto s = technique.sample(u);
        if (!(s.pdf > 0)) continue;
        const T weight = integrand(s.wi) / s.pdf;
        sum = sum + weight * nusselt::Vec3<T>{1, s.wi.x * s.wi.x, s.wi.y * s.wi.y};
    }
    return (T(1) / (kRows * kRows)) * sum;
}

/// What a technique integrates.
template <class T>
struct Integrals {
    T measure;
    nusselt::Vec3<T> moments;
};
template <class T, class Technique, class Integrand>
Integrals<T> integrals(const Technique& technique, const Integrand& integrand) {
    return {technique.measure(), moments<T>(technique, integrand)};
}

template <class T>
void expect_close(const Integrals<T>& got, const Integrals<T>& expected) {
    EXPECT_NEAR(got.measure / expected.measure, 1, T(0.05));
    EXPECT_NEAR(got.moments.x / expected.moments.x, 1, T(0.02));
    EXPECT_NEAR(got.moments.y / expected.moments.y, 1, T(0.03));
    EXPECT_NEAR(got.moments.z / expected.moments.z, 1, T(0.03));
}

/// Long lights that fill the half-space above the surface but for a tilt, which may be along the light, across it or
/// both. They are as a disk in the surface.
template <class T>
void expect_lit_long_half_spaces() {
    constexpr T kEpsilon = std::numeric_limits<T>::epsilon();
    constexpr int kSteps = nusselt::kConeSteps<T>, kPlaces = nusselt::kFineConePlaces;
    const LtcCoefficients<T> coefficients{T(0.35), T(-0.08), T(0.4), T(0.05), T(0.9), 1};
    const Ltc<T> lobe(coefficients);
    const auto cosine = [](const auto& wi) { return wi.z; };
    const auto one = [](const auto&) { return T(1); };
    const auto density = [&](const auto& wi) { return lobe.density(wi); };
    const nusselt::Disk<T> flat{{0, 0, 0}, {0, 0, 1}, 1};
    const auto by_cosine = integrals<T>(ConeProjectedSolidAngle<T, nusselt::Disk>(flat), cosine);
    const auto by_solid_angle = integrals<T>(nusselt::ConeClippedSolidAngle<T, nusselt::Disk>(flat), one);
    const auto by_density =
        integrals<T>(nusselt::ConeClippedLtc<T, nusselt::Disk, kSteps, kPlaces>(flat, lobe), density);
    constexpr T kTilts[] = {0, T(0.1), 1, 7, T(8.5), -20, 1000};
    for (const T height : {T(0.01), T(20)}) {
        for (const T width : {T(1) / 10, T(1) / 32, T(1) / 100, T(1) / 1000}) {
            for (const T along : kTilts) {
                for (const T across : kTilts) {
                    SCOPED_TRACE(testing::Message() << "height " << height << ", width " << width
                                                    << ", tilts " << along << " " << across);
                    const nusselt::Ellipse<T> ellipse{
                        {0, 0, height * kEpsilon},
                        {T(0.8), T(0.6), along * kEpsilon},
                        {T(-0.6) * width, T(0.8) * width, across * kEpsilon * width}};
                    const ConeProjectedSolidAngle<T, nusselt::Ellipse, kSteps, kPlaces> projected(ellipse);
                    const nusselt::ConeClippedSolidAngle<T, nusselt::Ellipse, kPlaces> clipped(ellipse);
                    const nusselt::ConeClippedLtc<T, nusselt::Ellipse, kSteps, kPlaces> on_lobe(ellipse,
                                                                                                lobe);
                    expect_close(integrals<T>(projected, cosine), by_cosine);
                    expect_close(integrals<T>(clipped, one), by_solid_angle);
                    expect_close(integrals<T>(on_lobe, density), by_density);
                }
            }
        }
    }
}

/// A wrong sampler, of an eighth of the light.
template <class Technique>
struct EighthOf {
    Technique technique;

    template <class T>
    auto sample(const nusselt::Vec2<T>& u) const {
        return technique.sample({u.x / 8, u.y});
    }
};

TEST(ConeMeasuresTest, MomentsTellWhetherSamplesCoverTheLight) {
    using Technique = ConeProjectedSolidAngle<float, nusselt::Disk>;
    const Technique technique(nusselt::Disk<float>{{0, 0, 0}, {0, 0, 1}, 1});
    const auto cosine = [](const auto& wi) { return wi.z; };
    const auto right = moments<float>(technique, cosine);
    const auto wrong = moments<float>(EighthOf<Technique>{technique}, cosine);
    EXPECT_NEAR(wrong.x / right.x, 1, 0.001);
    EXPECT_GT(std::fabs(wrong.y / right.y - 1), 0.3);
    EXPECT_GT(std::fabs(wrong.z / right.z - 1), 0.3);
}

TEST(ConeMeasuresTest, HalfSpacesThatRoundingTiltsAreLit) {
    expect_lit_half_spaces<float>();
    expect_lit_half_spaces<double>();
    expect_lit_long_half_spaces<float>();
    expect_lit_long_half_spaces<double>();
    const nusselt::Sphere<float> sphere{{-0x1p-20f, -0x1p-20f, 2}, 2};
    const ConeProjectedSolidAngle<float, nusselt::Sphere> technique(sphere);
    EXPECT_NEAR(technique.measure() / static_cast<float>(kPi), 1, 1e-5f);
}

} // namespace
} // namespace nusselt_test
