#include "lab/figures/picture.h"

#include <fmt/format.h>

#include <cmath>

namespace nusselt::lab {

namespace {

/// One digit after the point, and no minus sign in front of a zero.
std::string number(double x) { return fmt::format("{:.1f}", std::round(10 * x) / 10 + 0.0); }

} // namespace

std::string blended_colour(double u) {
    const auto mix = [&](double a, double b) { return static_cast<int>(std::lround(a + u * (b - a))); };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(0x1f, 0xe0), mix(0x5f, 0x7a), mix(0xb4, 0x10));
}

Picture::Picture(double width, double height)
    : text_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
                        "height=\"{1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
                        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
                        width, height)) {}

void Picture::path(const std::vector<Point>& points, bool closed, std::string_view style) {
    if (points.size() < 2) return;
    text_ += "<path d=\"";
    for (std::size_t i = 0; i < points.size(); ++i)
        text_ += fmt::format("{}{} {}",
                             i == 0   ? "M"
                             : i == 1 ? "L"
                                      : " ",
                             number(points[i].x), number(points[i].y));
    text_ += fmt::format("{}\" {}/>\n", closed ? "Z" : "", style);
}

void Picture::circle(const Point& centre, double radius, std::string_view style) {
    text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", number(centre.x), number(centre.y),
                         number(radius), style);
}

void Picture::dots(const std::vector<Point>& centres, std::string_view fill) {
    if (centres.empty()) return;
    text_ += "<path d=\"";
    for (const Point& p : centres) text_ += fmt::format("M{} {}h0", number(p.x), number(p.y));
    text_ += fmt::format("\" stroke=\"{}\" stroke-width=\"4.2\" stroke-linecap=\"round\"/>\n", fill);
}

void Picture::label(const Point& at, std::string_view text) {
    text_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"#222222\">{}</text>\n",
                         number(at.x), number(at.y), text);
}

std::string Picture::finished() { return text_ + "</svg>\n"; }

} // namespace nusselt::lab
