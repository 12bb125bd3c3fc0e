// Profiles whose flux and far field are known, in files of all versions, types, symmetries and kinds of TILT.

#include "base/temporary_folder.h"
#include "ies_cases.h"
#include "scene/model/profiles/profile_radiance.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace nusselt::scene::test {
namespace {

struct Lamp {
    const Case* source;
    IesFile file;
    IntensityProfile profile;
};

const std::vector<Lamp>& lamps() {
    static const std::vector<Case> kCases = cases();
    static const std::vector<Lamp> kLamps = [] {
        std::vector<Lamp> all;
        for (const Case& c : kCases) {
            static const base::TemporaryFolder kFolder;
            IesFile file = read_ies(write(c, kFolder.path()));
            IntensityProfile profile = make_profile(file);
            all.push_back({&c, std::move(file), std::move(profile)});
        }
        return all;
    }();
    return kLamps;
}

Double3 unit(double z, double azimuth) {
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/// The flux of a formula over the sphere, by its values at the centres of equal solid angles.
double quadrature(const Intensity& intensity) {
    constexpr int kRows = 800, kColumns = 360;
    double sum = 0;
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kColumns; ++j)
            sum += intensity(unit(-1 + (i + 0.5) * 2 / kRows, (j + 0.5) * 2 * kPi / kColumns));
    return sum * 4 * kPi / (kRows * kColumns);
}

constexpr double kFluxTolerance = 0.005;
constexpr double kFarFieldTolerance = 0.01;

double relative_error(double found, double expected) { return std::fabs(found / expected - 1); }

/// Radiance [W/(sr m^2)] by direction.
using Radiance = std::function<double(const IntensityProfile&, double area, const Double3& direction)>;

/// The largest relative error of the intensity that a square light of that radiance has in front of it, from the
/// irradiance at 50 times its size. Directions of less than a hundredth of the peak are left out.
double far_field_error(const Lamp& lamp, const Radiance& radiance) {
    constexpr double kSide = 0.7, kDistance = 50 * kSide;
    constexpr int kCells = 12;
    double worst = 0;
    for (const double vertical : {0.0, 10.0, 20.0, 35.0, 50.0, 65.0, 75.0})
        for (const double azimuth : {0.0, 47.0, 90.0, 133.0, 180.0, 228.0, 270.0, 311.0}) {
            const Double3 to_receiver = unit(std::cos(vertical * kDegree), azimuth * kDegree);
            const double expected = lamp.source->intensity(to_receiver);
            if (expected < 0.01 * lamp.profile.peak().candelas) continue;
            double irradiance = 0;
            for (int i = 0; i < kCells; ++i)
                for (int j = 0; j < kCells; ++j) {
                    const Double3 p{((i + 0.5) / kCells - 0.5) * kSide, ((j + 0.5) / kCells - 0.5) * kSide,
                                    0};
                    const Double3 path = kDistance * to_receiver - p;
                    const Double3 w = normalized(path);
                    irradiance += radiance(lamp.profile, kSide * kSide, w) * w.z * dot(w, to_receiver) *
                                  kSide * kSide / (kCells * kCells) / dot(path, path);
                }
            const double found = kLumensPerWatt * irradiance * kDistance * kDistance;
            worst = std::max(worst, relative_error(found, expected));
        }
    return worst;
}

TEST(IesProfile, FluxAgreesWithQuadratureAndClosedForms) {
    ASSERT_GE(lamps().size(), 20u);
    for (const Lamp& lamp : lamps()) {
        const double sampled = quadrature(lamp.source->intensity);
        const double expected = lamp.source->flux.value_or(sampled);
        // The hemisphere is the only one whose formula goes on where the file ends.
        if (lamp.source->name != "hemisphere, 1991") {
            EXPECT_LT(relative_error(sampled, expected), 1e-3) << lamp.source->name;
        }
        EXPECT_LT(relative_error(lamp.profile.flux(), expected), kFluxTolerance) << lamp.source->name;
        EXPECT_NEAR(lamp.profile.lower_flux() + lamp.profile.upper_flux(), lamp.profile.flux(),
                    1e-9 * lamp.profile.flux());
    }
}

TEST(IesProfile, FluxOfHemispheres) {
    const auto share_up = [](std::size_t i) {
        return lamps()[i].profile.upper_flux() / lamps()[i].profile.flux();
    };
    EXPECT_NEAR(share_up(0), 0.5, 1e-9);
    EXPECT_EQ(share_up(1), 0);
    for (const Lamp& lamp : lamps()) {
        if (lamp.source->name == "uplight") {
            EXPECT_EQ(lamp.profile.lower_flux(), 0);
        }
        if (lamp.source->name == "direct and indirect, 2019") {
            EXPECT_NEAR(lamp.profile.upper_flux() / lamp.profile.flux(), 1.0 / 3, 1e-3);
        }
    }
}

TEST(IesProfile, FluxTestRejectsAWrongCosine) {
    // The same integral with one cosine more.
    std::size_t rejected = 0;
    for (const Lamp& lamp : lamps())
        if (relative_error(lamp.profile.cosine_flux_between(0, kPi), *lamp.source->flux) >= kFluxTolerance)
            ++rejected;
    EXPECT_EQ(rejected, lamps().size());
}

TEST(IesProfile, FarFieldOfFlatLightsIsTheProfile) {
    for (const Lamp& lamp : lamps())
        EXPECT_LT(far_field_error(lamp, flat_radiance), kFarFieldTolerance) << lamp.source->name;
}

TEST(IesProfile, FarFieldTestRejectsWrongLights) {
    const auto rejected = [](const Radiance& mutant) {
        return std::count_if(lamps().begin(), lamps().end(), [&](const Lamp& lamp) {
            return far_field_error(lamp, mutant) >= kFarFieldTolerance;
        });
    };
    // The other handedness of horizontal angles: seven files distinguish it.
    EXPECT_EQ(rejected([](const IntensityProfile& profile, double area, const Double3& w) {
                  return flat_radiance(profile, area, {w.x, -w.y, w.z});
              }),
              7);
    // Horizontal angles from another axis.
    EXPECT_GE(rejected([](const IntensityProfile& profile, double area, const Double3& w) {
                  return flat_radiance(profile, area, {w.y, -w.x, w.z});
              }),
              9);
    // A constant radiance times the profile, which is narrower by a cosine: all but the uplight, which a flat light
    // cannot show.
    EXPECT_EQ(rejected([](const IntensityProfile& profile, double area, const Double3& w) {
                  return flat_radiance(profile, area, w) * w.z;
              }),
              static_cast<std::ptrdiff_t>(lamps().size()) - 1);
}

TEST(IesProfile, FarFieldOfBoxesIsTheProfile) {
    constexpr BoxSize kSize{0.8, 0.5, 0.3};
    constexpr double kDistance = 50 * 0.8;
    constexpr int kCells = 8;
    const double extent[] = {kSize.x, kSize.y, kSize.z};
    for (const std::size_t i : {std::size_t{0}, std::size_t{10}, std::size_t{15}})
        for (const double z : {-0.9, -0.3, 0.05, 0.4, 0.95}) {
            const Lamp& lamp = lamps()[i];
            const Double3 to_receiver = unit(z, 4.1);
            const double expected = lamp.source->intensity(to_receiver);
            if (expected < 0.01 * lamp.profile.peak().candelas) continue;
            double irradiance = 0;
            for (int face = 0; face < 6; ++face) {
                const int axis = face / 2;
                const double side = face % 2 == 0 ? 1 : -1;
                const int a = (axis + 1) % 3, b = (axis + 2) % 3;
                for (int j = 0; j < kCells * kCells; ++j) {
                    double p[3];
                    p[axis] = 0.5 * side * extent[axis];
                    p[a] = ((j % kCells + 0.5) / kCells - 0.5) * extent[a];
                    p[b] = ((j / kCells + 0.5) / kCells - 0.5) * extent[b];
                    const Double3 path = kDistance * to_receiver - Double3{p[0], p[1], p[2]};
                    const Double3 w = normalized(path);
                    const double components[] = {w.x, w.y, w.z};
                    const double cosine = std::max(side * components[axis], 0.0);
                    irradiance += box_radiance(lamp.profile, kSize, w) * cosine * dot(w, to_receiver) *
                                  extent[a] * extent[b] / (kCells * kCells) / dot(path, path);
                }
            }
            EXPECT_LT(relative_error(kLumensPerWatt * irradiance * kDistance * kDistance, expected),
                      kFarFieldTolerance)
                << lamp.source->name << ' ' << z;
        }
}

TEST(IesProfile, FlatLightsLoseWhatLeavesTheOtherSide) {
    for (const Lamp& lamp : lamps()) {
        const double lost = share_lost_by_flat_light(lamp.profile);
        const std::string& name = lamp.source->name;
        // The clamp takes epsilon / 2 of a constant intensity, epsilon^2 / 3 of a Lambertian one.
        if (name == "sphere, 1986") {
            EXPECT_NEAR(lost, 0.5 + 0.25 * kGrazingCosine, 1e-6);
        }
        if (name == "hemisphere, 1991") {
            EXPECT_NEAR(lost, 0.5 * kGrazingCosine, 1e-6);
        }
        if (name == "Lambertian, 1995") {
            EXPECT_NEAR(lost, kGrazingCosine * kGrazingCosine / 3, 2e-6);
        }
        if (name == "uplight") {
            EXPECT_EQ(lost, 1);
        }
        EXPECT_GE(lost, 0);
        EXPECT_LE(lost, 1);
    }
    const IntensityProfile dark({{0, kPi}, {0}, {0, 0}});
    EXPECT_EQ(share_lost_by_flat_light(dark), 0);
    EXPECT_EQ(dark.spread(0, 0.5), 0);
}

TEST(IesProfile, GrazingRadianceStaysFinite) {
    const IntensityProfile& sphere = lamps()[0].profile;
    EXPECT_DOUBLE_EQ(flat_radiance(sphere, 2, unit(1e-9, 0)), 100 / (kLumensPerWatt * 2 * kGrazingCosine));
    EXPECT_EQ(flat_radiance(sphere, 2, {1, 0, 0}), 0);
    EXPECT_EQ(flat_radiance(sphere, 2, {0, 0, -1}), 0);
    // A box without height has no sides.
    EXPECT_DOUBLE_EQ(box_radiance(sphere, {1, 2, 0}, {1, 0, 0}), 100 / (kLumensPerWatt * 2 * kGrazingCosine));
}

TEST(IesProfile, BeamAndFieldAngles) {
    const auto lamp = [](const std::string& name) -> const IntensityProfile& {
        const auto found = std::find_if(lamps().begin(), lamps().end(),
                                        [&](const Lamp& l) { return l.source->name == name; });
        return found->profile;
    };
    const auto lobe_angle = [](double exponent, double share) {
        return std::acos(std::pow(share, 1 / exponent)) / kDegree;
    };
    const auto degrees = [](const IntensityProfile& profile, double horizontal, double share) {
        return profile.spread(horizontal * kDegree, share) / kDegree;
    };
    EXPECT_NEAR(degrees(lamp("Lambertian, 1995"), 0, 0.5), 120, 0.1);
    EXPECT_NEAR(degrees(lamp("Lambertian, 1995"), 90, 0.1), 2 * lobe_angle(1, 0.1), 0.1);
    EXPECT_NEAR(degrees(lamp("cos^20, 2019"), 0, 0.5), 2 * lobe_angle(20, 0.5), 0.1);
    EXPECT_NEAR(degrees(lamp("cos^20, 2019"), 0, 0.1), 2 * lobe_angle(20, 0.1), 0.1);
    EXPECT_NEAR(degrees(lamp("sphere, 1986"), 0, 0.5), 360, 1e-9);
    EXPECT_NEAR(degrees(lamp("hemisphere, 1991"), 0, 0.5), 180, 1e-9);
    EXPECT_NEAR(degrees(lamp("uplight"), 0, 0.5), 120, 0.1);
    // Beside the axis, in one half of the plane only.
    EXPECT_NEAR(degrees(lamp("wall washer along 0"), 0, 0.9), 2 * lobe_angle(8, 0.9), 0.2);
    EXPECT_NEAR(degrees(lamp("wall washer along 90, 1995"), 270, 0.9), 2 * lobe_angle(8, 0.9), 0.2);
    EXPECT_EQ(degrees(lamp("wall washer along 0"), 90, 0.9), 0);
    // A ring of light, dark inside.
    const IntensityProfile ring({{0.5, 0.6, 1}, {0}, {1, 1, 1}});
    EXPECT_NEAR(ring.spread(0, 0.5), 2, 1e-12);
    const IntensityProfile cone_above({{2, 2.5}, {0}, {0, 1}});
    EXPECT_NEAR(cone_above.spread(0, 0.5), 2 * (kPi - 2.25), 1e-12);
}

TEST(IesProfile, HalfPlanesAgreeOnTheAxis) {
    const IntensityProfile profile({{0, 1, kPi}, {0, kPi / 2, kPi}, {4, 1, 0, 8, 1, 4, 4, 1, 4}});
    // Each half-plane counts for half of the angles to its neighbours: 3/8, 1/4, 3/8 of the circle.
    EXPECT_DOUBLE_EQ(profile.intensity({0, 0, 1}), 5);
    EXPECT_DOUBLE_EQ(profile.intensity({0, 0, -1}), 2.5);
    EXPECT_DOUBLE_EQ(profile.intensity_at(0, 3), 5);
    // Between the last half-plane and the first.
    EXPECT_NEAR(profile.intensity_at(1, 1.75 * kPi), 1, 1e-12);
    const IntensityProfile turned({{0, 1}, {1, 2}, {3, 3, 3, 7}});
    EXPECT_NEAR(turned.intensity_at(1, 0.5), 7 + (3.0 - 7) * (2 * kPi - 1.5) / (2 * kPi - 1), 1e-12);
    EXPECT_NEAR(turned.intensity_at(1, 5), 7 + (3.0 - 7) * 3 / (2 * kPi - 1), 1e-12);
    EXPECT_EQ(turned.intensity_at(1.001, 0.5), 0);
    EXPECT_EQ(turned.peak().candelas, 7);
    EXPECT_EQ(turned.peak().horizontal, 2);
}

} // namespace
} // namespace nusselt::scene::test
