#pragma once
/// Lobes of the shipped table.

#include "tables/ltc_table.h"

namespace nusselt::parity {

/// \param uniform draws numbers in [0, 1).
template <class Uniform>
LtcCoefficients<float> lobe_of_table(Uniform uniform) {
    const auto roughness = static_cast<float>(uniform());
    const auto cos_o = static_cast<float>(uniform());
    const auto f0 = static_cast<float>(uniform());
    return tables::frostbite_ltc_table().view().lookup(roughness, cos_o, f0);
}

template <class Real>
LtcCoefficients<Real> widened_lobe(const LtcCoefficients<float>& c) {
    return {c.m00, c.m02, c.m11, c.m20, c.m22, c.albedo};
}

} // namespace nusselt::parity
