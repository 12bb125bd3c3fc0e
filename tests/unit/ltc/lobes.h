#pragma once
/// Lobes like those of the fits, given by tilt and widths.

#include <cmath>
#include <string>
#include <vector>

#include <nusselt/ltc/coefficients.h>

namespace nusselt_test {

struct NamedLobe {
    std::string name;
    nusselt::LtcCoefficients<long double> coefficients;
};

/// \param tilt   angle of the axis from the normal, away from the eye.
/// \param width  in the plane of wo, twice the GGX alpha at normal incidence.
/// \param aspect that width over the width across.
/// \param skew   in the plane of wo.
inline nusselt::LtcCoefficients<long double> tilted_lobe(long double tilt, long double width,
                                                         long double aspect, long double skew) {
    const long double s = std::sin(tilt);
    const long double c = std::cos(tilt);
    return {c + skew * s, s - skew * c, aspect, -width * s, width * c, 1};
}

inline std::vector<NamedLobe> wide_lobes() {
    return {
        {"Lambertian", tilted_lobe(0, 1, 1, 0)},
        {"rough", tilted_lobe(0.5L, 0.8L, 1.1L, 0.1L)},
        {"rough, grazing", tilted_lobe(1.2L, 0.5L, 0.8L, -0.2L)},
        {"glossy", tilted_lobe(0.3L, 0.1L, 1.2L, 0.05L)},
    };
}

/// The wide lobes, and narrow ones down to the smallest width, seen from the normal and from the horizon.
inline std::vector<NamedLobe> all_lobes() {
    std::vector<NamedLobe> lobes = wide_lobes();
    lobes.push_back({"narrow", tilted_lobe(0.6L, 0.02L, 1, 0.05L)});
    lobes.push_back({"glossy, from the horizon", tilted_lobe(1.5L, 0.05L, 0.3L, 0)});
    lobes.push_back({"mirror, from the normal", tilted_lobe(0, 2e-4L, 1, 0)});
    lobes.push_back({"mirror", tilted_lobe(0.8L, 2e-4L, 1, 0)});
    lobes.push_back({"mirror, from the horizon", tilted_lobe(1.5707963L, 2e-4L, 0.5L, 0)});
    return lobes;
}

} // namespace nusselt_test
