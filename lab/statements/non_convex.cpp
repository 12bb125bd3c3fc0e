#include "lab/figures/picture.h"
#include "lab/figures/sampling_map.h"
#include "lab/statements/measurements.h"

#include <nusselt/sampling/polygon_projected_solid_angle.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace nusselt::lab {

namespace {

using Point = Vec2<double>;

/// A rectangle in the plane z = 1, in front of the point that is shaded.
struct Rectangle {
    double x0, x1, y0, y1;
};

/// A non-convex polygon, a bracket around an opening, from rectangles that touch, and the whole rectangle without the opening.
constexpr std::array kBracket = {Rectangle{-0.9, 0.9, 0.3, 0.7}, Rectangle{-0.9, -0.5, 0.7, 1.4},
                                 Rectangle{0.5, 0.9, 0.7, 1.4}, Rectangle{-0.9, 0.9, 1.4, 1.8}};
constexpr std::array kWhole = {Rectangle{-0.9, 0.9, 0.3, 1.8}};

/// Where a ray from the centre of the disk is in the light: squared radii, where it enters and where it leaves.
struct RadialRange {
    double enter, leave;
};

template <std::size_t kCount>
std::vector<RadialRange> intervals(const std::array<Rectangle, kCount>& light, double azimuth) {
    const double c = std::cos(azimuth), s = std::sin(azimuth);
    const auto squared_radius = [](double t) { return t * t / (t * t + 1); };
    std::vector<RadialRange> all;
    for (const Rectangle& part : light) {
        const double x[] = {part.x0 / c, part.x1 / c};
        const double near = std::max({std::min(x[0], x[1]), part.y0 / s, 0.0});
        const double far = std::min(std::max(x[0], x[1]), part.y1 / s);
        if (near < far) all.push_back({squared_radius(near), squared_radius(far)});
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.enter < b.enter; });
    return all;
}

double density_of(const std::vector<RadialRange>& all) {
    double sum = 0;
    for (const RadialRange& one : all) sum += (one.leave - one.enter) / 2;
    return sum;
}

/// The map of Arvo 2001: the azimuth by the first random number, then the radius by the second one, through all parts that
/// the azimuth crosses.
template <std::size_t kCount>
class MapByAzimuth {
public:
    explicit MapByAzimuth(const std::array<Rectangle, kCount>& light) : light_(light) {
        constexpr int kSteps = 20000;
        double sum = 0;
        for (int i = 0; i <= kSteps; ++i) {
            const double azimuth = kPi<double> * (i + 0.5) / (kSteps + 1);
            sum += density_of(intervals(light, azimuth));
            azimuths_.push_back(azimuth);
            sums_.push_back(sum);
        }
    }

    Point operator()(double u, double v) const {
        const double wanted = u * sums_.back();
        const auto above = std::upper_bound(sums_.begin(), sums_.end() - 1, wanted) - sums_.begin();
        const auto i = std::max<std::ptrdiff_t>(above, 1);
        const double rise = sums_[i] - sums_[i - 1];
        const double share = rise > 0 ? (wanted - sums_[i - 1]) / rise : 0;
        const double azimuth = azimuths_[i - 1] + share * (azimuths_[i] - azimuths_[i - 1]);
        const std::vector<RadialRange> all = intervals(light_, azimuth);
        double left = 2 * v * density_of(all), squared = 0;
        for (const RadialRange& one : all) {
            squared = one.enter + std::min(left, one.leave - one.enter);
            left -= one.leave - one.enter;
            if (left <= 0) break;
        }
        return std::sqrt(squared) * Point{std::cos(azimuth), std::sin(azimuth)};
    }

private:
    std::array<Rectangle, kCount> light_;
    std::vector<double> azimuths_, sums_;
};

/// Chooses a convex part by the first random number, in proportion to projected solid angles, and samples it.
template <std::size_t kCount>
class MapByParts {
public:
    explicit MapByParts(const std::array<Rectangle, kCount>& light) {
        for (const Rectangle& part : light) {
            const Vec3<double> corners[] = {
                {part.x0, part.y0, 1}, {part.x1, part.y0, 1}, {part.x1, part.y1, 1}, {part.x0, part.y1, 1}};
            parts_.emplace_back(make_polygon<4>(corners, 4));
            measure_ += parts_.back().measure();
        }
    }

    Point operator()(double u, double v) const {
        double left = u * measure_;
        std::size_t i = 0;
        for (; i + 1 < kCount && left >= parts_[i].measure(); ++i) left -= parts_[i].measure();
        const auto sample = parts_[i].sample({std::min(left / parts_[i].measure(), 1.0), v});
        return {sample.wi.x, sample.wi.y};
    }

private:
    std::vector<PolygonProjectedSolidAngle<double, 4>> parts_;
    double measure_ = 0;
};

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The largest distance of the images of neighbours in a square grid of random numbers.
template <class Map>
double largest_jump(const Map& map, int grid) {
    std::vector<Point> previous, row;
    double largest = 0;
    for (int i = 0; i < grid; ++i) {
        row.clear();
        for (int j = 0; j < grid; ++j) {
            row.push_back(map((i + 0.5) / grid, (j + 0.5) / grid));
            if (j > 0) largest = std::max(largest, distance(row[j], row[j - 1]));
            if (i > 0) largest = std::max(largest, distance(row[j], previous[j]));
        }
        std::swap(previous, row);
    }
    return largest;
}

/// The means of x^2, y and y^2 over a grid of random numbers: those of the light in the disk, if a map keeps areas.
template <class Map>
std::array<double, 3> moments(const Map& map) {
    constexpr int kGrid = 400;
    std::array<double, 3> sums{};
    for (int i = 0; i < kGrid; ++i)
        for (int j = 0; j < kGrid; ++j) {
            const Point p = map((i + 0.5) / kGrid, (j + 0.5) / kGrid);
            sums[0] += p.x * p.x;
            sums[1] += p.y;
            sums[2] += p.y * p.y;
        }
    for (double& sum : sums) sum /= kGrid * kGrid;
    return sums;
}

constexpr double kSide = 300, kHeader = 30, kRadius = 140;

template <class Map>
void draw(Picture& picture, int column, const char* title, const Map& map) {
    const Point centre = {kSide * (column + 0.5), kHeader + kRadius + 5};
    const auto at = [&](const Point& p) { return Point{centre.x + kRadius * p.x, centre.y - kRadius * p.y}; };
    picture.label({centre.x, 18}, title);
    picture.circle(centre, kRadius, kHorizon);
    // Lines of a constant second number: where they jump, neighbours have been torn apart.
    constexpr int kLines = 8, kSteps = 400;
    for (int j = 0; j < kLines; ++j) {
        std::vector<Point> path;
        for (int i = 0; i < kSteps; ++i) path.push_back(at(map((i + 0.5) / kSteps, (j + 0.5) / kLines)));
        picture.path(path, false, kConstantY);
    }
    std::vector<Point> dots;
    for (const Point& u : blue_noise_points(200)) dots.push_back(at(map(u.x, u.y)));
    picture.dots(dots, blended_colour(0));
}

} // namespace

Findings measure_non_convex(Effort effort) {
    const char* const kItem = "polygons-sec-3.8-non-convex";
    const int coarse = 64, fine = effort == Effort::quick ? 512 : 2048;
    Findings findings;
    Table table = {{"largest distance of neighbours in the unit disk", fmt::format("{0} x {0}", coarse),
                    fmt::format("{0} x {0}", fine)}};
    const auto add = [&](const std::string& name, const auto& map) {
        const double before = largest_jump(map, coarse), after = largest_jump(map, fine);
        table.push_back({name, fmt::format("{:.4f}", before), fmt::format("{:.4f}", after)});
        return after / before;
    };
    const MapByAzimuth bracket_by_azimuth(kBracket);
    const MapByAzimuth whole_by_azimuth(kWhole);
    const MapByParts bracket_by_parts(kBracket);
    const MapByParts whole_by_parts(kWhole);
    const std::string rest = ", largest distance of neighbours on the fine grid over that on the coarse one";
    findings.all.push_back(at_most(kItem, "rectangle by azimuth (Arvo)" + rest,
                                   add("rectangle by azimuth (Arvo)", whole_by_azimuth), 0.5));
    findings.all.push_back(at_most("polygons-sec-3.2-continuous-map",
                                   "rectangle by PolygonProjectedSolidAngle" + rest,
                                   add("rectangle by PolygonProjectedSolidAngle", whole_by_parts), 0.5));
    findings.all.push_back(at_least(kItem, "bracket by azimuth (Arvo)" + rest,
                                    add("bracket by azimuth (Arvo)", bracket_by_azimuth), 0.9));
    findings.all.push_back(at_least(kItem, "bracket by four rectangles" + rest,
                                    add("bracket by four rectangles", bracket_by_parts), 0.9));
    findings.tables.push_back(std::move(table));
    const auto expected = moments(bracket_by_parts), found = moments(bracket_by_azimuth);
    double deviation = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        deviation = std::max(deviation, std::fabs(found[i] - expected[i]));
    findings.all.push_back(at_most(
        kItem, "both maps of the bracket keep areas, largest difference of their moments", deviation, 1e-3));
    Picture picture(2 * kSide, kHeader + kRadius + 20);
    draw(picture, 0, "by azimuth (Arvo)", bracket_by_azimuth);
    draw(picture, 1, "by convex parts", bracket_by_parts);
    findings.drawings.push_back({"a non-convex polygon", "non-convex", picture.finished()});
    return findings;
}

} // namespace nusselt::lab
