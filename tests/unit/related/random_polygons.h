#pragma once
/// Random polygonal lights for tests of published methods, in scalars and in packs.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/simd/pack.h>

#include "lab/timing/scalar/lights.h"
#include "sampling/techniques.h"

namespace nusselt_test {

/// High enough above the horizon for published formulas, and yet with corners below it.
inline constexpr nusselt::lab::LightClass kClipped = {"clipped", 0.15, 0.2, 0.4, false};
/// In float, directions to the corners of such a light have three digits relative to its size.
inline constexpr nusselt::lab::LightClass kSmall = {"small", 0.5, 0.7, 0.001, false};

/// Polygons in both windings. They have up to N vertices; some leave one slot unused.
template <class T, int N>
std::vector<nusselt::ConvexPolygon<T, N>> random_polygons(const nusselt::lab::LightClass& light_class,
                                                          int count) {
    std::mt19937 generator(7);
    std::vector<nusselt::ConvexPolygon<T, N>> lights;
    for (int i = 0; i < count; ++i) {
        const int corner_count = i % 3 == 2 && N > 3 ? N - 1 : N;
        const auto corners = nusselt::lab::random_light(light_class, corner_count, generator);
        std::vector<nusselt::Vec3<T>> v;
        for (int j = 0; j < corner_count; ++j)
            v.push_back(nusselt::broadcast<T>(corners[static_cast<std::size_t>(j)]));
        if (i % 2 == 1) std::reverse(v.begin(), v.end());
        lights.push_back(nusselt::make_polygon<N>(v.data(), corner_count));
    }
    return lights;
}

/// The values of an array in the lanes of the packs of a struct, of a polygon or of random numbers.
template <int Lanes, class T, class Single>
auto packed(const Single* values) {
    auto result = nusselt::broadcast<nusselt::Pack<T, Lanes>>(values[0]);
    for (int lane = 1; lane < Lanes; ++lane) set_lane<T>(result, lane, values[lane]);
    return result;
}

/// The errors of many samples. A NaN counts as infinite.
class Errors {
public:
    void add(long double error) {
        errors_.push_back(std::isnan(error) ? HUGE_VALL : std::fabs(error));
        sorted_ = false;
    }
    /// The least error that a share of the samples does not exceed.
    long double quantile(double share) {
        if (!sorted_) std::sort(errors_.begin(), errors_.end());
        sorted_ = true;
        const auto rank = static_cast<std::size_t>(share * static_cast<double>(errors_.size()));
        return errors_[std::min(rank, errors_.size() - 1)];
    }
    long double largest() { return quantile(1); }

private:
    std::vector<long double> errors_;
    bool sorted_ = false;
};

} // namespace nusselt_test
