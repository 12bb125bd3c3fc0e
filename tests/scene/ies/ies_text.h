#pragma once
/// Writes IES files for tests, from intensities that are known as formulas.

#include "scene/import/ies/ies_profile.h"
#include "scene/model/vector_math.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace nusselt::scene::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDegree = kPi / 180;

/// An intensity [cd] by unit direction in the frame of the light.
using Intensity = std::function<double(const Double3&)>;

/// Equal steps [degrees].
inline std::vector<double> angles(double begin, double end, double step) {
    std::vector<double> result;
    const auto count = static_cast<int>(std::lround((end - begin) / step));
    for (int i = 0; i <= count; ++i) result.push_back(begin + step * i);
    return result;
}

/// What differs between the files, beside the intensity. The defaults are those of a plain file of 2002.
struct IesText {
    std::string first_line = "IESNA:LM-63-2002\n";
    std::string label = "[TEST] none\n[MANUFAC] Nusselt\n";
    std::string tilt = "TILT=NONE\n";
    std::string lamps = "1 -1";
    double multiplier = 1, ballast_factor = 1, field_12 = 1;
    int type = 1; ///< 1 C, 2 B, 3 A
    std::string opening = "2 0.5 0.5 0";
    std::vector<double> vertical = angles(0, 90, 2.5);
    std::vector<double> horizontal = {0};
    std::string separator = " "; ///< between candelas
    /// By what the reader has to multiply the numbers of the file.
    double factor = 1;

    /// The direction that a pair of angles means, written anew from the definitions of the types.
    Double3 direction(double vertical_angle, double horizontal_angle) const {
        const double v = vertical_angle * kDegree;
        const double h = horizontal_angle * kDegree;
        // Seen along the beam, with the half-plane of 0 degrees upward.
        const Double3 beam{0, 0, 1}, up{1, 0, 0}, right = cross(beam, up);
        const auto sum = [](double a, const Double3& x, double b, const Double3& y) { return a * x + b * y; };
        if (type == 1) {
            // From above, so along the beam, 90 degrees is a quarter turn to the left of 0.
            const Double3 half_plane = sum(std::cos(h), up, -std::sin(h), right);
            return sum(std::cos(v), beam, std::sin(v), half_plane);
        }
        // The axis of A points up, that of B to the right.
        if (type == 3) return sum(std::sin(v), up, std::cos(v), sum(std::cos(h), beam, std::sin(h), right));
        return sum(std::sin(h), right, std::cos(h), sum(std::cos(v), beam, std::sin(v), up));
    }

    std::string number(double value) const { return to_text(value); }

    std::string line(const std::vector<double>& values, const std::string& between) const {
        std::string text;
        for (std::size_t i = 0; i < values.size(); ++i)
            text += (i == 0 ? "" : i % 10 == 0 ? "\n" : between) + number(values[i]);
        return text + '\n';
    }

    std::string text(const Intensity& intensity) const {
        std::string result = first_line + label + tilt + lamps + ' ' + number(multiplier) + ' ' +
                             std::to_string(vertical.size()) + ' ' + std::to_string(horizontal.size()) + ' ' +
                             std::to_string(type) + ' ' + opening + '\n' + number(ballast_factor) + ' ' +
                             number(field_12) + " 100\n";
        result += line(vertical, " ") + line(horizontal, " ");
        for (const double h : horizontal) {
            std::vector<double> row;
            for (const double v : vertical) row.push_back(intensity(direction(v, h)) / factor);
            result += line(row, separator);
        }
        return result;
    }
};

inline IesFile parse(const std::string& text, const std::filesystem::path& path = "lamp.ies") {
    SourceFile source;
    source.path = path;
    return parse_ies(source, text);
}

} // namespace nusselt::scene::test
