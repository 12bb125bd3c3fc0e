#pragma once
/// Kinds of WindowedPolygon, and maps that lead to either way of sampling in cells, for tests.

#include <cmath>
#include <random>

#include "emission/windowed_lights.h"
#include "ltc/lobes.h"

namespace nusselt_test {

inline constexpr int kTexels = 64;

/// Noise over orders of magnitude, and black parts: most cells are busy.
inline const TexelMap& rough_map() {
    static const TexelMap map = [] {
        std::mt19937 random(2);
        std::uniform_real_distribution<double> uniform(0, 1);
        return TexelMap(kTexels, [&](const nusselt::Vec3<double>& w) {
            const double value = std::pow(uniform(random), 6);
            return std::sin(9 * w.x) > 0.8 ? 0 : value;
        });
    }();
    return map;
}

/// Hardly any noise: most cells are smooth.
inline const TexelMap& smooth_map() {
    static const TexelMap map(kTexels,
                              [](const nusselt::Vec3<double>& w) { return 1 + 0.05 * w.x + 0.03 * w.y; });
    return map;
}

template <class T>
nusselt::Ltc<T> glossy_lobe() {
    const auto c = tilted_lobe(0.5L, 0.4L, 1.1L, 0.1L);
    return nusselt::Ltc<T>({static_cast<T>(c.m00), static_cast<T>(c.m02), static_cast<T>(c.m11),
                            static_cast<T>(c.m20), static_cast<T>(c.m22), T(1)});
}

/// One kind of technique: lattice and measure.
template <int n_, template <class> class Measure_>
struct WindowedVariant {
    static constexpr int n = n_;
    static constexpr bool kHasLobe = std::is_same_v<Measure_<double>, nusselt::LobeCells<double>>;
    template <class T>
    using Technique = nusselt::WindowedPolygon<T, n, Measure_<T>>;

    template <class T>
    static Technique<T> technique(const nusselt::WindowedLight<T>& light, const nusselt::Vec3<T>& point,
                                  const nusselt::Frame<T>& frame) {
        if constexpr (kHasLobe)
            return Technique<T>(to_shading_space(light.plane, point, frame), light, {glossy_lobe<T>()});
        else
            return Technique<T>(to_shading_space(light.plane, point, frame), light);
    }
    /// The integrand that the technique is for, without the radiance.
    template <class T>
    static T integrand(const nusselt::Vec3<T>& wi) {
        if constexpr (kHasLobe)
            return glossy_lobe<T>().density(wi);
        else
            return std::max(wi.z, T(0));
    }
};

} // namespace nusselt_test
