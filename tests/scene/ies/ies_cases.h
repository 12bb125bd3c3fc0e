#pragma once
/// Files of all versions, types, symmetries and kinds of TILT, whose flux and far field are known.

#include "ies_text.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::scene::test {

struct Case {
    std::string name;
    IesText file;
    Intensity intensity;
    std::optional<double> flux; ///< where the integral is known [lm]
};

inline double peak_of(const Double3& direction, const Double3& w, double exponent) {
    return std::pow(std::max(dot(normalized(direction), w), 0.0), exponent);
}

/// 2 pi / (n + 1) for a lobe cos^n.
inline double lobe_flux(double exponent) { return 2 * kPi / (exponent + 1); }

inline const std::string kTiltIncluded = "TILT=INCLUDE\n2\n3\n0 45 90\n1 0.9,0.75\n";

inline std::vector<Case> cases() {
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

/// Writes a file into a folder, with that of its TILT beside it. \returns its path
inline std::filesystem::path write(const Case& c, const std::filesystem::path& folder) {
    std::ofstream(folder / "lamp.tlt") << "1\n2\n0 90\n1 0.8\n";
    std::string text = c.file.text(c.intensity);
    if (c.name == "A askew, numbered as C in 1986") {
        const std::size_t type = text.find(" 3 2 0.5");
        EXPECT_NE(type, std::string::npos);
        text[type + 1] = '1';
    }
    std::ofstream(folder / "lamp.ies", std::ios::binary) << text;
    return folder / "lamp.ies";
}

} // namespace nusselt::scene::test
