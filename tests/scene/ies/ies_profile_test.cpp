// Profiles whose flux and far field are known, in files of all versions, types, symmetries and kinds of TILT.

#include "base/temporary_folder.h"
#include "ies_text.h"
#include "scene/model/profiles/profile_radiance.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::scene::test {
namespace {

struct Case {
    std::string name;
    IesText file;
    Intensity intensity;
    std::optional<double> flux; ///< where the integral is known [lm]
};

double peak_of(const Double3& direction, const Double3& w, double exponent) {
    return std::pow(std::max(dot(normalized(direction), w), 0.0), exponent);
}

/// 2 pi / (n + 1) for a lobe cos^n.
double lobe_flux(double exponent) { return 2 * kPi / (exponent + 1); }

const std::string kTiltIncluded = "TILT=INCLUDE\n2\n3\n0 45 90\n1 0.9,0.75\n";

std::vector<Case> cases() {
    const Intensity sphere = [](const Double3&) { return 100.0; };
    const Intensity lambert = [](const Double3& w) { return 1000 * std::max(w.z, 0.0); };
    const auto lobe = [](const Double3& direction, double exponent) {
        return [=](const Double3& w) { return 1000 * peak_of(direction, w, exponent); };
    };
    // 30 degrees off the axis, into the half-planes of 0, of 90, and of about 55 degrees.
    const Double3 to_0{0.5, 0, std::sqrt(0.75)}, to_90{0, -0.5, std::sqrt(0.75)}, askew{0.3, -0.42, 0.9};
    const std::vector<double> fine = angles(0, 90, 1), front = angles(-90, 90, 1);
    const std::vector<double> to_zenith = angles(0, 180, 2);
    const double flux8 = 1000 * lobe_flux(8), flux20 = 1000 * lobe_flux(20);
    const std::string v1986 = "A lamp measured long ago\n", v1991 = "IESNA91\n",
                      v1995 = "IESNA:LM-63-1995\r\n", v2019 = "IES:LM-63-2019\n";

    std::vector<Case> all;
    const auto add = [&](const char* name, const Intensity& intensity, std::optional<double> flux,
                         IesText file) {
        all.push_back({name, std::move(file), intensity, flux});
    };
    add("sphere, 1986", sphere, 400 * kPi,
        {.first_line = v1986,
         .label = "no keywords\n",
         .multiplier = 2,
         .ballast_factor = 0.9,
         .field_12 = 1.1,
         .opening = "1 -1 0 -1",
         .vertical = angles(0, 180, 30),
         .factor = 2 * 0.9 * 1.1});
    add("hemisphere, 1991", sphere, 200 * kPi,
        {.first_line = v1991,
         .field_12 = 0.5,
         .vertical = {0, 30, 90},
         .horizontal = {0, 45, 90},
         .factor = 0.5});
    add("Lambertian, 1995", lambert, 1000 * kPi,
        {.first_line = v1995, .lamps = "3.0 1200", .ballast_factor = 0.8, .field_12 = 1.1, .factor = 0.8});
    add("Lambertian with commas, 2002", lambert, 1000 * kPi,
        {.opening = "1 2 2 0", .horizontal = angles(0, 360, 45), .separator = ","});
    add("Lambertian of an accredited laboratory, 2019", lambert, 1000 * kPi,
        {.first_line = v2019, .field_12 = 1.10001, .horizontal = angles(0, 90, 30), .separator = " ,\n "});
    add("Lambertian with a TILT file, 1995", lambert, 1000 * kPi,
        {.first_line = v1995, .tilt = "TILT=lamp.tlt\n"});
    add("cos^8, 1991", lobe({0, 0, 1}, 8), flux8, {.first_line = v1991, .vertical = fine});
    add("cos^20, 2019", lobe({0, 0, 1}, 20), flux20,
        {.first_line = v2019, .tilt = kTiltIncluded, .vertical = fine, .horizontal = angles(0, 180, 22.5)});
    add("wall washer along 0", lobe(to_0, 8), flux8,
        {.vertical = angles(0, 180, 1), .horizontal = angles(0, 180, 2.5)});
    add("wall washer along 90, 1995", lobe(to_90, 8), flux8,
        {.first_line = v1995, .vertical = angles(0, 180, 1), .horizontal = angles(90, 270, 2.5)});
    add("askew, 2002", lobe(askew, 8), flux8,
        {.vertical = angles(0, 180, 1), .horizontal = angles(0, 360, 2.5)});
    add("askew without 360, 1986", lobe(askew, 8), flux8,
        {.first_line = v1986, .vertical = angles(0, 180, 1), .horizontal = angles(0, 357.5, 2.5)});
    add("batwing",
        [](const Double3& w) { return 100 * std::max(w.z, 0.0) * (1 + 8 * std::pow(1 - w.z * w.z, 2)); },
        100 * kPi * 11 / 3, {.tilt = kTiltIncluded, .horizontal = angles(0, 90, 15)});
    add("batwing across 0, 1995",
        [](const Double3& w) { return 100 * std::max(w.z, 0.0) * (1 + 4 * w.x * w.x); }, 200 * kPi,
        {.first_line = v1995, .horizontal = angles(0, 90, 5)});
    add("uplight", [](const Double3& w) { return 1000 * std::max(-w.z, 0.0); }, 1000 * kPi,
        {.vertical = angles(90, 180, 2.5)});
    add("direct and indirect, 2019", [](const Double3& w) { return 200 * (w.z > 0 ? w.z : -0.5 * w.z); },
        300 * kPi,
        {.first_line = v2019, .opening = "2 0.3 1.2 0.1", .vertical = to_zenith, .horizontal = {0, 90}});
    add("B mirrored, 1991", lobe({0, 0, 1}, 8), flux8,
        {.first_line = v1991, .type = 2, .vertical = fine, .horizontal = fine});
    add("B askew, 1995", lobe(askew, 8), flux8,
        {.first_line = v1995, .type = 2, .vertical = front, .horizontal = front});
    add("A mirrored left and right, 2002", lobe({0.5, 0, std::sqrt(0.75)}, 8), flux8,
        {.type = 3, .vertical = front, .horizontal = angles(0, 180, 1)});
    add("A mirrored up and down, 2019", lobe({0, -0.5, std::sqrt(0.75)}, 8), flux8,
        {.first_line = v2019, .type = 3, .vertical = fine, .horizontal = angles(-150, 150, 1)});
    add("A askew, all around", lobe(askew, 8), flux8,
        {.type = 3, .vertical = front, .horizontal = angles(-180, 180, 1)});
    add("A askew, numbered as C in 1986", lobe(askew, 8), flux8,
        {.first_line = v1986, .type = 3, .vertical = front, .horizontal = front});
    return all;
}

/// Writes the file, with that of its TILT beside it, and reads it.
IesFile read(const Case& c) {
    static const base::TemporaryFolder kFolder;
    std::ofstream(kFolder / "lamp.tlt") << "1\n2\n0 90\n1 0.8\n";
    std::string text = c.file.text(c.intensity);
    if (c.name == "A askew, numbered as C in 1986") {
        const std::size_t type = text.find(" 3 2 0.5");
        EXPECT_NE(type, std::string::npos);
        text[type + 1] = '1';
    }
    std::ofstream(kFolder / "lamp.ies", std::ios::binary) << text;
    return read_ies(kFolder / "lamp.ies");
}

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
            IesFile file = read(c);
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
