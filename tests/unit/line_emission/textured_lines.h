#pragma once
/// Lines, profiles and lobes that tests of lights with a profile share.

#include <cmath>
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

} // namespace nusselt_test
