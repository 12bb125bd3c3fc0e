#include "lab/statements/measurements.h"
#include "tables/ltc_table.h"

#include <nusselt/sampling/polygon_ltc.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nusselt::lab {

namespace {

using Direction = Vec3<double>;

/// Calls visit(u) for points of the unit square: midpoints of a grid.
template <class Visit>
void for_each_midpoint(int count, const Visit& visit) {
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) visit(Vec2<double>{(i + 0.5) / count, (j + 0.5) / count});
}

/// Proportional to the cosine.
Direction cosine_direction(const Vec2<double>& u) {
    const double radius = std::sqrt(u.x);
    const double azimuth = 2 * kPi<double> * u.y;
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1 - u.x)};
}

/// Share of a lobe below the surface.
double share_of_lobe_below(const Ltc<double>& ltc, int count) {
    int below = 0;
    for_each_midpoint(count,
                      [&](const Vec2<double>& u) { below += ltc.to_shading(cosine_direction(u)).z < 0; });
    return static_cast<double>(below) / (count * count);
}

/// A wall of side 1 m opposite to the eye, at a distance of 1 m. A mirror would show its middle, or a point above. A quarter of
/// it or more is below the surface.
ConvexPolygon<double, 4> wall_opposite_to(double cos_o) {
    constexpr double kHalf = 0.5;
    const double sin_o = std::sqrt(1 - cos_o * cos_o);
    const double middle = std::min(cos_o / sin_o, kHalf / 2);
    const Direction corners[] = {{-1, -kHalf, middle - kHalf},
                                 {-1, kHalf, middle - kHalf},
                                 {-1, kHalf, middle + kHalf},
                                 {-1, -kHalf, middle + kHalf}};
    return make_polygon<4>(corners, 4);
}

/// Share of the samples of PolygonLtc below the surface.
double share_of_samples_below(const PolygonLtc<double, 4>& technique, int count) {
    int below = 0;
    for_each_midpoint(count, [&](const Vec2<double>& u) { below += technique.sample(u).wi.z < 0; });
    return static_cast<double>(below) / (count * count);
}

struct Share {
    double sum = 0, largest = 0;
    int count = 0;
    void add(const Share& other) {
        sum += other.sum;
        largest = std::max(largest, other.largest);
        count += other.count;
    }
    void add(double share) { add({share, share, 1}); }
    double mean() const { return sum / count; }
};

} // namespace

Findings measure_lobe_samples(Effort effort) {
    const int grid = effort == Effort::quick ? 16 : 64;
    const int step = effort == Effort::quick ? 3 : 1;
    const LtcTableView table = tables::frostbite_ltc_table().view();
    const auto at = [](int i, int count) { return static_cast<double>(i) / (count - 1); };
    Share of_lobes, of_walls;
    Table by_angle = {
        {"below the surface: mean / largest share [%]", "of whole lobes", "of samples of a wall"}};
    for (int i = 0; i < table.inclinations; i += step) {
        const double inclination = at(i, table.inclinations) * (kPi<double> / 2);
        const double cos_o = std::max(std::cos(inclination), 1e-3);
        Share lobes_here, walls_here;
        for (int r = 0; r < table.roughnesses; r += step)
            for (int f = 0; f < table.f0s; f += 10) {
                const Ltc<double> ltc(table.lookup(at(r, table.roughnesses), cos_o, at(f, table.f0s)));
                lobes_here.add(share_of_lobe_below(ltc, grid));
                if (inclination < kPi<double> / 4) continue; // a mirror shows no wall
                const PolygonLtc<double, 4> technique(wall_opposite_to(cos_o), ltc);
                if (technique.measure() > 0.01) walls_here.add(share_of_samples_below(technique, grid));
            }
        of_lobes.add(lobes_here);
        of_walls.add(walls_here);
        const auto text = [](const Share& share) {
            return share.count == 0 ? std::string("-")
                                    : fmt::format("{:.2f} / {:.1f}", 100 * share.mean(), 100 * share.largest);
        };
        by_angle.push_back({fmt::format("{:.1f} degrees", inclination * (180 / kPi<double>)),
                            text(lobes_here), text(walls_here)});
    }
    const char* const kItem = "polygons-sec-4.1-below-horizon";
    return {{at_most(kItem, fmt::format("mean share of {} lobes below the surface", of_lobes.count),
                     of_lobes.mean(), 0.02),
             at_most(kItem, "largest share of a lobe below the surface", of_lobes.largest, 0.25),
             at_most(kItem,
                     fmt::format("mean share of samples below the surface, walls that stand in it, {} lobes",
                                 of_walls.count),
                     of_walls.mean(), 0.03),
             at_most(kItem, "largest share of these", of_walls.largest, 0.3)},
            {by_angle}};
}

} // namespace nusselt::lab
