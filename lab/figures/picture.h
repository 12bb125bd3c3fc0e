#pragma once
/// Vector graphics for drawings of lights as shading points see them.

#include <nusselt/core/vec.h>

#include <string>
#include <string_view>
#include <vector>

namespace nusselt::lab {

/// Blends from the first colour to the second as u goes from 0 to 1.
std::string blended_colour(double u);

// Attributes of paths and circles.
inline constexpr const char* kOutline =
    "fill=\"none\" stroke=\"#222222\" stroke-width=\"1.4\" stroke-linejoin=\"round\"";
inline constexpr const char* kHorizon = "fill=\"#f2f2f2\" stroke=\"#888888\" stroke-width=\"1\"";
inline constexpr const char* kConstantX = "fill=\"none\" stroke=\"#1f5fb4\" stroke-width=\"0.9\"";
inline constexpr const char* kConstantY = "fill=\"none\" stroke=\"#c25e00\" stroke-width=\"0.9\"";
inline constexpr const char* kConstruction =
    "fill=\"none\" stroke=\"#7a9a7a\" stroke-width=\"0.7\" stroke-dasharray=\"3 2\"";

/// An SVG file. Coordinates are pixels from the top left, with one digit after the point.
class Picture {
public:
    using Point = Vec2<double>;

    Picture(double width, double height);

    /// Points that are joined by straight lines; nothing if there are less than two.
    void path(const std::vector<Point>& points, bool closed, std::string_view style);
    void circle(const Point& centre, double radius, std::string_view style);
    /// Dots: lines of no length with round caps.
    void dots(const std::vector<Point>& centres, std::string_view fill);
    /// Text that is centred horizontally.
    void label(const Point& at, std::string_view text);
    /// Closes the file. Nothing can be added any more.
    std::string finished();

private:
    std::string text_;
};

} // namespace nusselt::lab
