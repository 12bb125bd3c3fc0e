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

template <class T, int Lanes>
void set_lane(nusselt::Vec3<nusselt::Pack<T, Lanes>>& packed, int lane, const nusselt::Vec3<T>& v) {
    packed.x.set_lane(lane, v.x);
    packed.y.set_lane(lane, v.y);
    packed.z.set_lane(lane, v.z);
}
template <class T, int Lanes>
nusselt::Vec3<T> get_lane(const nusselt::Vec3<nusselt::Pack<T, Lanes>>& packed, int lane) {
    return {packed.x.lane(lane), packed.y.lane(lane), packed.z.lane(lane)};
}

/// Lights in the lanes of a pack.
template <int Lanes, class T, int N>
nusselt::ConvexPolygon<nusselt::Pack<T, Lanes>, N> packed(const nusselt::ConvexPolygon<T, N>* lights) {
    using Real = nusselt::Pack<T, Lanes>;
    auto result = nusselt::broadcast<Real>(lights[0]);
    for (int lane = 1; lane < Lanes; ++lane) {
        for (int j = 0; j < N; ++j) {
            set_lane(result.vertex[j], lane, lights[lane].vertex[j]);
            set_lane(result.edge[j], lane, lights[lane].edge[j]);
        }
        set_lane(result.normal, lane, lights[lane].normal);
    }
    return result;
}
/// Random numbers in the lanes of a pack.
template <int Lanes, class T>
nusselt::Vec2<nusselt::Pack<T, Lanes>> packed(const nusselt::Vec2<T>* u) {
    auto result = nusselt::broadcast<nusselt::Pack<T, Lanes>>(u[0]);
    for (int lane = 1; lane < Lanes; ++lane) {
        result.x.set_lane(lane, u[lane].x);
        result.y.set_lane(lane, u[lane].y);
    }
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
