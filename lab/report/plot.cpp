#include "lab/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nusselt::lab {

namespace {

constexpr double kWidth = 420;
constexpr double kHeight = 300;
constexpr double kLeft = 72;
constexpr double kTop = 34;
constexpr double kBottom = 46;
constexpr double kLegend = 275;
constexpr double kRow = 18;

// Apart for people with any kind of colour vision (M. Okabe and K. Ito 2008).
constexpr std::array kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9",
                                "#e69f00", "#000000", "#999933", "#882255", "#332288"};

bool is_drawable(const PlotPoint& p) {
    return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// A logarithmic axis: which numbers it shows and where, from 0 to 1.
struct Axis {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double share(double value) const { return std::log(value / low) / std::log(high / low); }
};

/// Spans at least a factor of two; any range if nothing is drawn.
Axis with_margin(Axis axis) {
    if (!(axis.high > 0)) return {1, 10};
    return {axis.low / 1.15, std::max(axis.high, 2 * axis.low) * 1.15};
}

/// Powers of ten, with 2 and 5 times them if these are few.
std::vector<double> ticks(const Axis& axis) {
    std::vector<double> all, decades;
    const int first = static_cast<int>(std::floor(std::log10(axis.low)));
    const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
    for (int e = first; e <= last; ++e)
        for (const int digit : {1, 2, 5}) {
            const double value = digit * std::pow(10.0, e);
            if (value < axis.low || value > axis.high) continue;
            all.push_back(value);
            if (digit == 1) decades.push_back(value);
        }
    return decades.size() < 3 ? all : decades;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string text_at(double x, double y, const char* attributes, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes, escaped(text));
}

std::string line_between(double x0, double y0, double x1, double y1, const std::string& attributes) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x0, y0, x1, y1,
                       attributes);
}

std::string stroke_of(const PlotCurve& curve, std::size_t index) {
    return fmt::format("stroke=\"{}\" stroke-width=\"1.8\"{}", kColors[index % kColors.size()],
                       curve.stroke == Stroke::dashed ? " stroke-dasharray=\"5 3\"" : "");
}

} // namespace

std::string to_svg(const Plot& plot) {
    Axis x_axis, y_axis;
    for (const PlotCurve& curve : plot.curves)
        for (const PlotPoint& p : curve.points)
            if (is_drawable(p)) {
                x_axis.include(p.x);
                y_axis.include(p.y);
            }
    x_axis = with_margin(x_axis);
    y_axis = with_margin(y_axis);
    const auto x_of = [&](double value) { return kLeft + kWidth * x_axis.share(value); };
    const auto y_of = [&](double value) { return kTop + kHeight * (1 - y_axis.share(value)); };
    const double right = kLeft + kWidth;
    const double bottom = kTop + kHeight;

    const double height =
        std::max(bottom + kBottom, kTop + kRow * static_cast<double>(plot.curves.size() + 1));
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} "
        "{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"#fff\"/>\n",
        right + kLegend, height);
    svg += text_at(kLeft + kWidth / 2, kTop - 12, "text-anchor=\"middle\" font-size=\"14\"", plot.title);
    for (const double tick : ticks(x_axis)) {
        svg += line_between(x_of(tick), kTop, x_of(tick), bottom, "stroke=\"#ddd\"");
        svg += text_at(x_of(tick), bottom + 16, "text-anchor=\"middle\"", fmt::format("{:g}", tick));
    }
    for (const double tick : ticks(y_axis)) {
        svg += line_between(kLeft, y_of(tick), right, y_of(tick), "stroke=\"#ddd\"");
        svg += text_at(kLeft - 6, y_of(tick) + 4, "text-anchor=\"end\"", fmt::format("{:.0e}", tick));
    }
    svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#666\"/>\n",
                       kLeft, kTop, kWidth, kHeight);
    svg += text_at(kLeft + kWidth / 2, bottom + 36, "text-anchor=\"middle\"", plot.x_label);
    svg +=
        fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                    kTop + kHeight / 2, escaped(plot.y_label));

    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
        const std::string stroke = stroke_of(plot.curves[i], i);
        std::string path;
        for (const PlotPoint& p : plot.curves[i].points)
            if (is_drawable(p)) path += fmt::format(" {:.1f},{:.1f}", x_of(p.x), y_of(p.y));
        svg += fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", path, stroke);
        const double y = kTop + 10 + kRow * static_cast<double>(i);
        svg += line_between(right + 12, y, right + 40, y, stroke);
        svg += text_at(right + 46, y + 4, "", plot.curves[i].label);
    }
    return svg + "</svg>\n";
}

} // namespace nusselt::lab
