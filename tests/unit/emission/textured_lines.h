#pragma once
/// Lines, profiles and lobes that tests of lights with a profile share.

#include <cmath>
#include <random>
#include <vector>

#include <nusselt/line_emission/line_profile.h>
#include <nusselt/ltc/ltc.h>

#include "ltc/lobes.h"

namespace nusselt_test {

/// Grey texels as functions of their place in [0, 1].
template <class T, class Value>
nusselt::LineProfile<T> profile_of(int count, const Value& value) {
    std::vector<nusselt::Vec3<T>> texels;
    for (int k = 0; k < count; ++k) {
        const auto x = static_cast<T>(value((k + 0.5) / count));
        texels.push_back({x, x, x});
    }
    return nusselt::make_line_profile(texels.data(), count);
}

/// Four bright dots.
inline bool dots(double x) { return static_cast<int>(x * 16) % 4 == 0; }

template <class Real>
nusselt::Ltc<Real> glossy_lobe() {
    const auto c = tilted_lobe(0.5L, 0.4L, 1.1L, 0.1L);
    return nusselt::Ltc<Real>({Real(c.m00), Real(c.m02), Real(c.m11), Real(c.m20), Real(c.m22), Real(1)});
}

/// Draws coordinates of all sizes, many of which lead through the shading point or to its plane.
template <class T>
class HostileCoordinates {
public:
    T operator()() { return static_cast<T>(kChoices[index_(random_)]); }
    nusselt::Vec3<T> point(T scale) {
        const T x = (*this)(), y = (*this)(), z = (*this)();
        return {scale * x, scale * y, scale * z};
    }

private:
    static constexpr double kChoices[] = {0, 0, 1, -1, 0.5, 1e-6, -1e-6, 1e-3, 1e6, -1e6, 1e-9, 0.3333333};
    std::mt19937 random_{6};
    std::uniform_int_distribution<std::size_t> index_{0, 11};
};

} // namespace nusselt_test
