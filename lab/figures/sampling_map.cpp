#include "lab/figures/sampling_map.h"

#include "lab/figures/picture.h"

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

// What techniques construct is drawn behind their maps.

void draw_no_construction(Picture&, const Disk&, const Polygon&) {}

/// The ellipses to which the great circles of edges are projected, and rays from the zenith through the vertices, which bound
/// the sectors.
void draw_sectors(Picture& picture, const Disk& disk, const Polygon& light) {
    constexpr int kSteps = 120;
    const ConvexPolygon<double, 5> upper = clip_to_horizon(light);
    for (int j = 0; j < 5; ++j) {
        if (!(length(upper.edge[j]) > 0)) continue;
        const Direction a = normalize(upper.vertex[j]);
        const Direction b = normalize(cross(cross(a, upper.edge[j]), a));
        std::vector<Point> ellipse;
        for (int i = 0; i < kSteps; ++i) {
            const double angle = 2 * kPi<double> * i / kSteps;
            ellipse.push_back(disk.at(std::cos(angle) * a + std::sin(angle) * b));
        }
        picture.path(ellipse, true, kConstruction);
        const Direction azimuth = normalize(Direction{a.x, a.y, 0});
        picture.path({disk.centre, disk.at(azimuth)}, false, kConstruction);
    }
}

/// The vertex from which all triangles and all arcs of samples start.
void draw_first_vertex(Picture& picture, const Disk& disk, const Polygon& light) {
    const Direction w = normalize(light.vertex[0]);
    if (w.z >= 0) picture.circle(disk.at(w), 5, kOutline);
}

using DrawConstruction = void (*)(Picture& picture, const Disk& disk, const Polygon& light);

/// Dots in as many colours as there are columns of the grid.
/// \param place where in the picture the point with given random numbers is; nothing if it is not in it.
template <class Place>
void draw_dots(Picture& picture, const std::vector<Point>& random_numbers, const Place& place) {
    std::vector<Point> columns[kGridCells];
    for (const Point& u : random_numbers)
        if (const std::optional<Point> p = place(u))
            columns[static_cast<int>(u.x * kGridCells)].push_back(*p);
    for (int i = 0; i < kGridCells; ++i) picture.dots(columns[i], blended_colour((i + 0.5) / kGridCells));
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

template <class Technique, DrawConstruction draw_construction = draw_no_construction>
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
        draw_construction(picture, grid, views[v].light);
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
        draw_construction(picture, noise, views[v].light);
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
                                 blended_colour((cell + 0.5) / kLineCells)));
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
                                 blended_colour((cell + 0.5) / kLineCells)));
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
    {"PolygonSolidAngle", draw_polygons<PolygonSolidAngle<double, 4>, draw_first_vertex>},
    {"PolygonClippedSolidAngle", draw_polygons<PolygonClippedSolidAngle<double, 4>, draw_first_vertex>},
    {"PolygonProjectedSolidAngle", draw_polygons<PolygonProjectedSolidAngle<double, 4>, draw_sectors>},
    {"PolygonProjectedSolidAngleBiased",
     draw_polygons<PolygonProjectedSolidAngleBiased<double, 4>, draw_sectors>},
    {"PolygonSolidAngleArvo", draw_polygons<PolygonSolidAngleArvo<double, 4>, draw_first_vertex>},
    {"PolygonProjectedSolidAngleArvo",
     draw_polygons<PolygonProjectedSolidAngleArvo<double, 4>, draw_sectors>},
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
