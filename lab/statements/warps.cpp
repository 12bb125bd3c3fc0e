#include "lab/statements/measurements.h"

#include <nusselt/related/polygon_warp_hart.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nusselt::lab {

namespace {

using Corners = std::vector<Vec3<double>>;

/// Relative standard deviation of the estimate of the projected solid angle by one sample of a quadrilateral.
template <template <class, int> class Technique>
double deviation(const Corners& corners) {
    constexpr int kGrid = 200;
    const Technique<double, 4> technique(make_polygon<4>(corners.data(), 4));
    double sum = 0, squares = 0;
    for (int i = 0; i < kGrid; ++i)
        for (int j = 0; j < kGrid; ++j) {
            const auto s = technique.sample({(i + 0.5) / kGrid, (j + 0.5) / kGrid});
            const double weight = s.pdf > 0 ? std::max(s.wi.z, 0.0) / s.pdf : 0;
            sum += weight;
            squares += weight * weight;
        }
    const double mean = sum / (kGrid * kGrid);
    return std::sqrt(std::max(squares / (kGrid * kGrid) - mean * mean, 0.0)) / mean;
}

struct Method {
    const char* name;
    double (*deviation)(const Corners& corners);
};
constexpr Method kMethods[] = {
    {"PolygonClippedSolidAngle", deviation<PolygonClippedSolidAngle>},
    {"PolygonClippedBilinearWarpHart", deviation<PolygonClippedBilinearWarpHart>},
    {"PolygonClippedBiquadraticWarpHart", deviation<PolygonClippedBiquadraticWarpHart>}};

/// A wall that stands in the surface, lower on one side.
const Corners kWall = {{1, -1, -0.5}, {1, 1, -0.25}, {1, 1, 1}, {1, -1, 1}};

/// A quadrilateral whose first vertex is at a height.
Corners with_first_vertex_at(double z) {
    return {{1, -0.5, z}, {1, 0.5, 0.5}, {1, 0.25, 1.25}, {1, -0.75, 0.75}};
}

double ratio(double a, double b) { return std::max(a, b) / std::min(a, b); }

} // namespace

Findings measure_warps(Effort /*it takes no time*/) {
    const char* const kItem = "polygons-sec-6.2-order-of-vertices";
    Findings findings;
    Table table = {{"standard deviation over mean, one sample", "from vertex 0", "from vertex 1",
                    "from vertex 2", "from vertex 3", "just above the horizon", "just below"}};
    for (const Method& method : kMethods) {
        table.push_back({method.name});
        double smallest = 1e9, largest = 0;
        for (int first = 0; first < 4; ++first) {
            Corners corners = kWall;
            std::rotate(corners.begin(), corners.begin() + first, corners.end());
            const double here = method.deviation(corners);
            smallest = std::min(smallest, here);
            largest = std::max(largest, here);
            table.back().push_back(fmt::format("{:.4f}", here));
        }
        const double above = method.deviation(with_first_vertex_at(1e-6));
        const double below = method.deviation(with_first_vertex_at(-1e-6));
        table.back().push_back(fmt::format("{:.4f}", above));
        table.back().push_back(fmt::format("{:.4f}", below));
        const std::string of = std::string(", ") + method.name;
        const std::string order = "noise of the worst first vertex over that of the best" + of;
        const std::string jump = "noise on both sides of where clipping begins, ratio" + of;
        if (&method == &kMethods[0]) {
            findings.all.push_back(at_most(kItem, order, largest / smallest, 1.01));
            findings.all.push_back(at_most(kItem, jump, ratio(above, below), 1.001));
        } else {
            findings.all.push_back(at_least(kItem, order, largest / smallest, 1.2));
            findings.all.push_back(at_least(kItem, jump, ratio(above, below), 1.02));
        }
    }
    findings.tables.push_back(std::move(table));
    return findings;
}

} // namespace nusselt::lab
