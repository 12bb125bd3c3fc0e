/// Skies against values that follow from the published coefficients by hand, and against what is known of daylight.

#include "scene/sky/preetham_sky.h"

#include "scene/model/profiles/profile_radiance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nusselt::scene {
namespace {

constexpr double kPi = std::numbers::pi;

Double3 direction(double from_zenith, double azimuth) {
    return {std::sin(from_zenith) * std::cos(azimuth), std::sin(from_zenith) * std::sin(azimuth),
            std::cos(from_zenith)};
}

TEST(PreethamSky, ZenithHasThePublishedLuminance) {
    // On the horizon, the tangent is 0.
    EXPECT_NEAR(PreethamSky(2, {1, 0, 0}).zenith_luminance(), 1988.2, 1e-6);
    EXPECT_NEAR(PreethamSky(6, {0, 1, 0}).zenith_luminance(), 1126.2, 1e-6);
    // Where 4/9 - T/120 times the angle is a quarter of pi, it is 1.
    const double angle = kPi / 2 - kPi / 8 / (4.0 / 9 - 4.0 / 120);
    EXPECT_NEAR(PreethamSky(4, direction(angle, 0.3)).zenith_luminance(), 12767.4, 1e-6);
    EXPECT_NEAR(PreethamSky(2, {0, 0, 1}).zenith_luminance(), 15501, 1);
}

TEST(PreethamSky, ZenithHasThePublishedChromaticity) {
    // Only the last column counts if the sun is at the zenith.
    const Chromaticity high = PreethamSky(3, {0, 0, 2}).zenith_chromaticity();
    EXPECT_NEAR(high.x, 0.27068, 1e-9);
    EXPECT_NEAR(high.y, 0.28236, 1e-9);
    // One radian: the sums of the rows.
    const Chromaticity low = PreethamSky(2, direction(1, 2)).zenith_chromaticity();
    EXPECT_NEAR(low.x, 0.22435 + 2 * 0.00666, 1e-9);
    EXPECT_NEAR(low.y, 0.21948 + 2 * 0.01119 + 4 * -0.00018, 1e-9);
}

TEST(PreethamSky, RadianceOfTheZenithIsThatOfTheModel) {
    for (const double turbidity : {2.0, 3.5, 6.0}) {
        const PreethamSky sky(turbidity, direction(0.7, 1));
        const Double3 radiance = sky.sky_radiance({0, 0, 1});
        EXPECT_NEAR(kLumensPerWatt * luminance(radiance) / sky.zenith_luminance(), 1, 1e-9);
        const auto& [x, y] = sky.zenith_chromaticity();
        const Double3 expected = srgb_from_xyz(xyz_of({x, y}));
        EXPECT_NEAR(radiance.z / radiance.y, expected.z / expected.y, 1e-9);
        // The sky is blue.
        EXPECT_GT(radiance.z, 1.2 * radiance.x);
    }
}

TEST(PreethamSky, IsTheSameOnBothSidesOfTheSun) {
    const PreethamSky sky(3, direction(1, 0.4));
    const PreethamSky turned(3, direction(1, 1.4));
    for (const double from_zenith : {0.1, 0.8, 1.5}) {
        for (const double azimuth : {0.2, 1.0, 3.0}) {
            const Double3 left = sky.sky_radiance(direction(from_zenith, 0.4 + azimuth));
            const Double3 right = sky.sky_radiance(direction(from_zenith, 0.4 - azimuth));
            const Double3 around = turned.sky_radiance(direction(from_zenith, 1.4 + azimuth));
            EXPECT_NEAR(left.y, right.y, 1e-9 * left.y);
            EXPECT_NEAR(left.z, right.z, 1e-9 * left.z);
            EXPECT_NEAR(left.y, around.y, 1e-9 * left.y);
        }
    }
    // It is brightest next to the sun.
    const double next_to_sun = luminance(sky.sky_radiance(sky.to_sun()));
    EXPECT_GT(next_to_sun, 2 * luminance(sky.sky_radiance(direction(1, 1.6))));
}

TEST(PreethamSky, IsFiniteAtTheHorizonAndBelow) {
    for (const double turbidity : {-1.0, 1.0, 2.0, 10.0, 100.0}) {
        for (const Double3& sun :
             {Double3{0, 0, 1}, {0, 0, -1}, {1, 0, 1e-9}, {1e-200, 0, 0}, {0, -1e200, -1e-9}}) {
            const PreethamSky sky(turbidity, sun);
            const auto expect_finite = [](const Double3& radiance) {
                for (const double channel : {radiance.x, radiance.y, radiance.z})
                    EXPECT_TRUE(channel >= 0 && channel < 1e8);
            };
            expect_finite(sky.sun_radiance());
            EXPECT_GE(sky.to_sun().z, 0);
            for (const double z : {1.0, 1e-2, 1e-6, 1e-300, 0.0, -1e-300, -1e-6, -0.5, -1.0}) {
                const double across = std::sqrt(1 - z * z);
                expect_finite(sky.sky_radiance({across, 0, z}));
                expect_finite(sky.sky_radiance({-0.6 * across, 0.8 * across, z}));
            }
            const Double3 horizon = sky.sky_radiance({0.6, 0.8, 0});
            EXPECT_GT(luminance(horizon), 0);
            EXPECT_NEAR(sky.sky_radiance({0.36, 0.48, -0.8}).y, horizon.y, 1e-12 * horizon.y);
            EXPECT_NEAR(sky.sky_radiance({0.6, 0.8, 1e-6}).y, horizon.y, 1e-4 * horizon.y);
        }
    }
}

TEST(PreethamSky, TurbidityIsLimitedToTheRangeOfTheModel) {
    EXPECT_EQ(PreethamSky(1, {1, 0, 1}).zenith_luminance(), PreethamSky(2, {1, 0, 1}).zenith_luminance());
    EXPECT_EQ(PreethamSky(99, {1, 0, 1}).zenith_luminance(), PreethamSky(10, {1, 0, 1}).zenith_luminance());
}

/// On a surface that faces the sun [lx].
double illuminance_of_sun(const PreethamSky& sky) {
    return kLumensPerWatt * luminance(sky.sun_radiance()) * kPi * PreethamSky::kSunRadius *
           PreethamSky::kSunRadius;
}

/// The sun brings about 100 000 lx through clear air from the zenith, and red light from the horizon.
TEST(PreethamSky, SunHasTheIlluminanceOfDaylight) {
    const PreethamSky noon(2, {0, 0, 1});
    EXPECT_GT(illuminance_of_sun(noon), 90000);
    EXPECT_LT(illuminance_of_sun(noon), 120000);
    const Double3 white = noon.sun_radiance();
    EXPECT_GT(white.x / white.z, 1.1);
    EXPECT_LT(white.x / white.z, 1.5);
    const PreethamSky evening(2, direction(85 * kPi / 180, 0));
    EXPECT_LT(illuminance_of_sun(evening), 0.2 * illuminance_of_sun(noon));
    EXPECT_GT(evening.sun_radiance().x, 5 * evening.sun_radiance().z);
    EXPECT_LT(illuminance_of_sun(PreethamSky(6, {0, 0, 1})), 0.8 * illuminance_of_sun(noon));
}

TEST(PreethamSky, DiskHasItsRadius) {
    const PreethamSky sky(3, direction(0.5, 0));
    EXPECT_TRUE(sky.is_in_sun(direction(0.5, 0)));
    EXPECT_TRUE(sky.is_in_sun(direction(0.5 + 0.99 * PreethamSky::kSunRadius, 0)));
    EXPECT_FALSE(sky.is_in_sun(direction(0.5 + 1.01 * PreethamSky::kSunRadius, 0)));
    EXPECT_FALSE(sky.is_in_sun(direction(-0.5, 0)));
}

} // namespace
} // namespace nusselt::scene
