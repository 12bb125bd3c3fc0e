#include "lab/figures/sampling_map.h"

#include <nusselt/geometry/clip_polygon.h>
#include <nusselt/random/pcg.h>
#include <nusselt/random/unit_interval.h>
#include <nusselt/related/polygon_projected_solid_angle_arvo.h>
#include <nusselt/related/polygon_solid_angle_arvo.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using Point = Vec2<double>;
using Direction = Vec3<double>;
using Polygon = ConvexPolygon<double, 4>;
using Line = LineSegment<double>;

constexpr double kColumn = 232, kRow = 226, kHeader = 30, kDisk = 100, kSquare = 150;
constexpr int kGridCells = 12; // as in Fig. 13 of Peters 2021
constexpr int kStepsPerCell = 10;
constexpr int kPoints = 256;
constexpr int kLineCells = 16;

struct PolygonView {
    const char* title;
    Polygon light;
};
struct LineView {
    const char* title;
    Line light;
};

Polygon parallelogram(const Direction& corner, const Direction& a, const Direction& b) {
    const Direction corners[] = {corner, corner + a, corner + a + b, corner + b};
    return make_polygon<4>(corners, 4);
}

std::vector<PolygonView> polygon_views() {
    return {{"beside the zenith", parallelogram({0.3, -1.1, 1.1}, {1.0, 0.35, -0.6}, {0.1, 1.5, 0.1})},
            {"around the zenith", parallelogram({-0.9, -0.7, 0.9}, {1.7, 0.2, 0.1}, {-0.2, 1.5, 0})},
            {"across the horizon", parallelogram({0.6, -1.2, -0.6}, {0.1, 2.1, 0.2}, {-0.15, 0.05, 1.5})}};
}

std::vector<LineView> line_views() {
    return {{"above the surface", make_line(Direction{-1.1, 0.35, 0.6}, Direction{1.2, 0.5, 0.8})},
            {"one end near the surface", make_line(Direction{0.5, -0.5, 0.04}, Direction{-0.9, 0.9, 1.1})},
            {"across the horizon", make_line(Direction{0.9, -1.0, -0.5}, Direction{0.2, 0.9, 1.0})}};
}

/// Blends from the first colour to the second as u goes from 0 to 1.
std::string colour(double u) {
    const auto mix = [&](double a, double b) { return static_cast<int>(std::lround(a + u * (b - a))); };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(0x1f, 0xe0), mix(0x5f, 0x7a), mix(0xb4, 0x10));
}

/// One digit after the point, and no minus sign in front of a zero.
std::string number(double x) { return fmt::format("{:.1f}", std::round(10 * x) / 10 + 0.0); }

class Picture {
public:
    Picture(double width, double height)
        : text_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
                            "height=\"{1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
                            "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
                            width, height)) {}

    void path(const std::vector<Point>& points, bool closed, std::string_view style) {
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
    void circle(const Point& centre, double radius, std::string_view style) {
        text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", number(centre.x),
                             number(centre.y), number(radius), style);
    }
    /// Dots: lines of no length with round caps.
    void dots(const std::vector<Point>& centres, std::string_view fill) {
        if (centres.empty()) return;
        text_ += "<path d=\"";
        for (const Point& p : centres) text_ += fmt::format("M{} {}h0", number(p.x), number(p.y));
        text_ += fmt::format("\" stroke=\"{}\" stroke-width=\"4.2\" stroke-linecap=\"round\"/>\n", fill);
    }
    void label(const Point& at, std::string_view text) {
        text_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"#222222\">{}</text>\n",
                             number(at.x), number(at.y), text);
    }
    std::string finished() { return text_ + "</svg>\n"; }

private:
    std::string text_;
};

constexpr const char* kOutline =
    "fill=\"none\" stroke=\"#222222\" stroke-width=\"1.4\" stroke-linejoin=\"round\"";
constexpr const char* kHorizon = "fill=\"#f2f2f2\" stroke=\"#888888\" stroke-width=\"1\"";
constexpr const char* kConstantX = "fill=\"none\" stroke=\"#1f5fb4\" stroke-width=\"0.9\"";
constexpr const char* kConstantY = "fill=\"none\" stroke=\"#c25e00\" stroke-width=\"0.9\"";

/// A place in the picture where a hemisphere is drawn as a disk.
struct Disk {
    Point centre;
    Point at(const Direction& w) const { return {centre.x + kDisk * w.x, centre.y - kDisk * w.y}; }
};

void draw_horizon(Picture& picture, const Disk& disk) {
    picture.circle(disk.centre, kDisk, kHorizon);
    picture.path({disk.at({-0.03, 0, 1}), disk.at({0.03, 0, 1})}, false, kOutline);
    picture.path({disk.at({0, -0.03, 1}), disk.at({0, 0.03, 1})}, false, kOutline);
}

void draw_outline(Picture& picture, const Disk& disk, const Polygon& light) {
    constexpr int kSteps = 24;
    const ConvexPolygon<double, 5> upper = clip_to_horizon(light);
    std::vector<Point> points;
    for (int j = 0; j < 5; ++j) {
        if (!(length(upper.edge[j]) > 0)) continue;
        for (int i = 0; i < kSteps; ++i)
            points.push_back(
                disk.at(normalize(upper.vertex[j] + (static_cast<double>(i) / kSteps) * upper.edge[j])));
    }
    picture.path(points, true, kOutline);
}

/// Dots in as many colours as there are columns of the grid.
/// \param place where in the picture the point with given random numbers is; nothing if it is not in it.
template <class Place>
void draw_dots(Picture& picture, const std::vector<Point>& random_numbers, const Place& place) {
    std::vector<Point> columns[kGridCells];
    for (const Point& u : random_numbers)
        if (const std::optional<Point> p = place(u))
            columns[static_cast<int>(u.x * kGridCells)].push_back(*p);
    for (int i = 0; i < kGridCells; ++i) picture.dots(columns[i], colour((i + 0.5) / kGridCells));
}

double clamped(double u) { return below_one(u); }

/// The image of a curve of random numbers, interrupted below the horizon.
template <class Curve>
void draw_curve(Picture& picture, const Disk& disk, const Curve& curve, const char* style) {
    constexpr int kSteps = kGridCells * kStepsPerCell;
    std::vector<Point> points;
    for (int i = 0; i <= kSteps; ++i) {
        const Direction w = curve(clamped(static_cast<double>(i) / kSteps));
        if (w.z >= 0) {
            points.push_back(disk.at(w));
        } else {
            picture.path(points, false, style);
            points.clear();
        }
    }
    picture.path(points, false, style);
}

/// Left of the panels: the random numbers themselves.
struct Square {
    Point corner; ///< where both random numbers are 0; the second one grows upwards
    Point at(const Point& u) const { return {corner.x + kSquare * u.x, corner.y - kSquare * u.y}; }
};

Disk disk_at(int column, int row) { return {{kColumn * (column + 0.5), kHeader + kRow * row + kDisk + 4}}; }
Square square_at(int row) {
    return {{0.5 * (kColumn - kSquare), kHeader + kRow * row + kDisk + 4 + kSquare / 2}};
}

void draw_random_numbers(Picture& picture, const std::vector<Point>& points) {
    const Square grid = square_at(0);
    const Square noise = square_at(1);
    for (int i = 0; i <= kGridCells; ++i) {
        const double u = static_cast<double>(i) / kGridCells;
        picture.path({grid.at({u, 0}), grid.at({u, 1})}, false, kConstantX);
        picture.path({grid.at({0, u}), grid.at({1, u})}, false, kConstantY);
    }
    draw_dots(picture, points, [&](const Point& u) { return std::optional(noise.at(u)); });
    for (const Square& square : {grid, noise}) {
        picture.path({square.at({0, 0}), square.at({1, 0}), square.at({1, 1}), square.at({0, 1})}, true,
                     kOutline);
        picture.label(square.at({0.5, -0.11}), "u.x");
        picture.label(square.at({-0.1, 0.47}), "u.y");
    }
    picture.label({kColumn / 2, 18}, "random numbers");
}

std::string share_text(int below, int count) {
    return fmt::format("{} % of samples below the horizon", (200 * below + count) / (2 * count));
}

template <class Technique>
std::string draw_polygons() {
    const auto views = polygon_views();
    const std::vector<Point> points = blue_noise_points(kPoints);
    Picture picture(kColumn * static_cast<double>(views.size() + 1), kHeader + 2 * kRow);
    draw_random_numbers(picture, points);
    for (std::size_t v = 0; v < views.size(); ++v) {
        const Technique technique(views[v].light);
        const Disk grid = disk_at(static_cast<int>(v) + 1, 0);
        const Disk noise = disk_at(static_cast<int>(v) + 1, 1);
        picture.label({grid.centre.x, 18}, views[v].title);
        draw_horizon(picture, grid);
        for (int i = 0; i <= kGridCells; ++i) {
            const double fixed = clamped(static_cast<double>(i) / kGridCells);
            draw_curve(
                picture, grid,
                [&](double u) {
                    return technique.sample({fixed, u}).wi;
                },
                kConstantX);
            draw_curve(
                picture, grid,
                [&](double u) {
                    return technique.sample({u, fixed}).wi;
                },
                kConstantY);
        }
        draw_outline(picture, grid, views[v].light);
        draw_horizon(picture, noise);
        int below = 0;
        draw_dots(picture, points, [&](const Point& u) -> std::optional<Point> {
            const Direction w = technique.sample(u).wi;
            if (w.z >= 0) return noise.at(w);
            ++below;
            return std::nullopt;
        });
        draw_outline(picture, noise, views[v].light);
        if (below > 0)
            picture.label({noise.centre.x, noise.centre.y + kDisk + 16}, share_text(below, kPoints));
    }
    return picture.finished();
}

/// The strip that a tube covers in the disk: between its sides, at the azimuths -kHalfWidth and kHalfWidth around the
/// axis. The techniques sample the limit of a thin tube; this one is thick enough to be seen.
class Tube {
public:
    explicit Tube(const Line& light)
        : s_(light.s), t_(normalize(light.p0 - dot(light.p0, light.s) * light.s)), u_(cross(s_, t_)) {}

    /// The point of a side in the cross section of a direction towards the axis.
    Direction side(const Direction& wi, double azimuth) const {
        const double across = std::max(dot(wi, t_), 0.0);
        return dot(wi, s_) * s_ + across * (std::cos(azimuth) * t_ + std::sin(azimuth) * u_);
    }

private:
    Direction s_, t_, u_;
};

template <class Technique>
void draw_line(Picture& picture, const Disk& disk, const Line& light) {
    constexpr double kHalfWidth = 0.09;
    const Technique technique(light);
    const Tube tube(light);
    constexpr int kSteps = kLineCells * kStepsPerCell;
    int below = 0;
    for (int cell = 0; cell < kLineCells; ++cell) {
        std::vector<Point> left, right;
        for (int i = 0; i <= kStepsPerCell; ++i) {
            const int step = cell * kStepsPerCell + i;
            const Direction w = technique.sample(clamped(static_cast<double>(step) / kSteps)).wi;
            if (w.z < 0) {
                if (i < kStepsPerCell) ++below;
                continue;
            }
            left.push_back(disk.at(tube.side(w, -kHalfWidth)));
            right.push_back(disk.at(tube.side(w, kHalfWidth)));
        }
        left.insert(left.end(), right.rbegin(), right.rend());
        picture.path(left, true,
                     fmt::format("fill=\"{}\" stroke=\"#222222\" stroke-width=\"0.8\"",
                                 colour((cell + 0.5) / kLineCells)));
    }
    if (below > 0) picture.label({disk.centre.x, disk.centre.y + kDisk + 16}, share_text(below, kSteps));
}

template <class Technique>
std::string draw_lines() {
    const auto views = line_views();
    Picture picture(kColumn * static_cast<double>(views.size() + 1), kHeader + kRow);
    const Square square = square_at(0);
    for (int cell = 0; cell < kLineCells; ++cell) {
        const double begin = static_cast<double>(cell) / kLineCells;
        const double end = static_cast<double>(cell + 1) / kLineCells;
        picture.path({square.at({0.42, begin}), square.at({0.58, begin}), square.at({0.58, end}),
                      square.at({0.42, end})},
                     true,
                     fmt::format("fill=\"{}\" stroke=\"#222222\" stroke-width=\"0.8\"",
                                 colour((cell + 0.5) / kLineCells)));
    }
    picture.label(square.at({0.32, 0.47}), "u");
    picture.label({kColumn / 2, 18}, "random number");
    for (std::size_t v = 0; v < views.size(); ++v) {
        const Disk disk = disk_at(static_cast<int>(v) + 1, 0);
        picture.label({disk.centre.x, 18}, views[v].title);
        draw_horizon(picture, disk);
        draw_line<Technique>(picture, disk, views[v].light);
    }
    return picture.finished();
}

struct Map {
    const char* technique;
    std::string (*draw)();
};

constexpr Map kMaps[] = {
    {"PolygonArea", draw_polygons<PolygonArea<double, 4>>},
    {"PolygonSolidAngle", draw_polygons<PolygonSolidAngle<double, 4>>},
    {"PolygonClippedSolidAngle", draw_polygons<PolygonClippedSolidAngle<double, 4>>},
    {"PolygonProjectedSolidAngle", draw_polygons<PolygonProjectedSolidAngle<double, 4>>},
    {"PolygonProjectedSolidAngleBiased", draw_polygons<PolygonProjectedSolidAngleBiased<double, 4>>},
    {"PolygonSolidAngleArvo", draw_polygons<PolygonSolidAngleArvo<double, 4>>},
    {"PolygonProjectedSolidAngleArvo", draw_polygons<PolygonProjectedSolidAngleArvo<double, 4>>},
    {"LineArea", draw_lines<LineArea<double>>},
    {"LineSolidAngle", draw_lines<LineSolidAngle<double>>},
    {"LineClippedSolidAngle", draw_lines<LineClippedSolidAngle<double>>},
    {"LineProjectedSolidAngle", draw_lines<LineProjectedSolidAngle<double>>},
};

} // namespace

std::vector<std::string> mapped_techniques() {
    std::vector<std::string> names;
    for (const Map& map : kMaps) names.emplace_back(map.technique);
    return names;
}

std::string draw_sampling_map(std::string_view technique) {
    for (const Map& map : kMaps)
        if (map.technique == technique) return map.draw();
    throw std::runtime_error(fmt::format("unknown technique '{}'; use one of {}", technique,
                                         fmt::join(mapped_techniques(), ", ")));
}

std::vector<Point> blue_noise_points(int count) {
    constexpr int kCandidates = 16; // for each point that is already there
    Pcg32 random(1);
    const auto next = [&] { return to_unit<double>(random()); };
    const auto squared_distance = [](const Point& a, const Point& b) {
        const double x = std::fabs(a.x - b.x);
        const double y = std::fabs(a.y - b.y);
        const Point d{std::min(x, 1 - x), std::min(y, 1 - y)};
        return dot(d, d);
    };
    std::vector<Point> points{{next(), next()}};
    while (static_cast<int>(points.size()) < count) {
        Point best{};
        double farthest = -1;
        for (std::size_t i = 0; i < kCandidates * points.size(); ++i) {
            const double x = next();
            const Point candidate{x, next()};
            double nearest = 1;
            for (const Point& other : points) nearest = std::min(nearest, squared_distance(candidate, other));
            if (nearest <= farthest) continue;
            farthest = nearest;
            best = candidate;
        }
        points.push_back(best);
    }
    return points;
}

} // namespace nusselt::lab
